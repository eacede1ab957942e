#pragma once
/// What a machine does to a valve at work that no bench does; all off unless a scenario's [machine] says otherwise.
/// Oil, leakage, tank pressure, wear of friction and errors of position sensor and thermometer are figures of plant and
/// instruments, and scenarios set them there.
#include "spoolflow/rig/hydraulics/actuator_end.hpp"
#include "spoolflow/rig/hydraulics/supply.hpp"
#include "spoolflow/rig/instruments/coil_panel.hpp"
#include "spoolflow/rig/instruments/vibration.hpp"

namespace spoolflow::rig {

struct Machine {
  PumpRipple ripple;
  PwmRipple pwm;
  Vibration vibration;
  ActuatorEnd actuator_end;
  CurrentSpikes spikes;

  bool operator==(const Machine&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("ripple", self.ripple);
    visit("pwm", self.pwm);
    visit("vibration", self.vibration);
    visit("actuator_end", self.actuator_end);
    visit("spikes", self.spikes);
  }
};

}  // namespace spoolflow::rig
