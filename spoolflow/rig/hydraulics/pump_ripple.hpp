#pragma once
/// Ripple of a machine's pump on the pressure before the valve: one line at the pistons' frequency, one below it from
/// an unequal piston or the shaft.
///
///     p_ripple(t) = a_1 sin(2 pi f_1 t) + a_2 sin(2 pi f_2 t)
///
/// It frees spool and armature as dither does and leaves no trace in the current. Comes on top of the bench's own
/// (supply.hpp). Piston pumps: Ivantysyn and Ivantysynova, Hydrostatic Pumps and Motors, 2001.
#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct PumpRipple {
  double amplitude_bar = 0.0;
  double frequency_Hz = 225.0;
  double second_amplitude_bar = 0.0;
  double second_frequency_Hz = 25.0;

  bool operator==(const PumpRipple&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"amplitude_bar", "bar", 0, 20, "half of peak to peak; 0.5 to 4 % of the pressure"},
          self.amplitude_bar);
    visit(Parameter{"frequency_Hz", "Hz", 1, 2000, "pistons times speed: 9 at 1500 rev/min"}, self.frequency_Hz);
    visit(Parameter{"second_amplitude_bar", "bar", 0, 20, "half of peak to peak of the second line"},
          self.second_amplitude_bar);
    visit(Parameter{"second_frequency_Hz", "Hz", 1, 2000, "the shaft's turns: 25 at 1500 rev/min"},
          self.second_frequency_Hz);
  }
};

/// What the pump adds to the source's pressure [Pa].
inline double pump_ripple_Pa(const PumpRipple& ripple, double time_s) {
  if (ripple.amplitude_bar == 0 && ripple.second_amplitude_bar == 0) return 0.0;
  constexpr double Pa_per_bar = 1e5;
  return Pa_per_bar * (ripple.amplitude_bar * sine_of_turns(ripple.frequency_Hz * time_s) +
                       ripple.second_amplitude_bar * sine_of_turns(ripple.second_frequency_Hz * time_s));
}

}  // namespace spoolflow::rig
