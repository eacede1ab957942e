#pragma once
/// Shunt and voltage divider at the coil. Both channels are means over one sample period, so their noise falls with the
/// number of conversions averaged.
#include "spoolflow/rig/instruments/transducer.hpp"

namespace spoolflow::rig {

struct CurrentShunt {
  double gain_error = 1.0e-4;
  double offset_A = 0.0;
  double noise_A = 1.6e-3;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "shunt of 0.02 % (paper, section 3)"}, self.gain_error);
    visit(Parameter{"offset_A", "A", -0.1, 0.1, "input offset over the shunt: below 1 mA"}, self.offset_A);
    visit(Parameter{"noise_A", "A", 0, 0.1, "one conversion at 10 kHz; 0.5 mA in a mean over 1 ms"}, self.noise_A);
  }
};

struct VoltageDivider {
  double gain_error = -2.0e-4;
  double offset_V = 0.0;
  double noise_V = 0.09;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "resistors of 0.05 %"}, self.gain_error);
    visit(Parameter{"offset_V", "V", -1, 1, "below 5 mV"}, self.offset_V);
    visit(Parameter{"noise_V", "V", 0, 2, "one conversion at 10 kHz; 30 mV in a mean over 1 ms"}, self.noise_V);
  }
};

inline TransducerErrors errors(const CurrentShunt& shunt) {
  return {.gain_error = shunt.gain_error, .offset = shunt.offset_A, .noise = shunt.noise_A};
}
inline TransducerErrors errors(const VoltageDivider& divider) {
  return {.gain_error = divider.gain_error, .offset = divider.offset_V, .noise = divider.noise_V};
}

}  // namespace spoolflow::rig
