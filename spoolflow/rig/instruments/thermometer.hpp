#pragma once
/// Resistance thermometer in the oil before the valve.
#include "spoolflow/rig/instruments/transducer.hpp"

namespace spoolflow::rig {

struct Thermometer {
  double offset_K = 0.0;
  double time_constant_s = 2.0;
  double noise_K = 0.05;
  double resolution_K = 0.01;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"offset_K", "K", -10, 10, "Pt100 class A: within 0.3 K"}, self.offset_K);
    visit(Parameter{"time_constant_s", "s", 0, 60, "3 mm probe in flowing oil: 1 to 5 s"}, self.time_constant_s);
    visit(Parameter{"noise_K", "K", 0, 2, "standard deviation"}, self.noise_K);
    visit(Parameter{"resolution_K", "K", 0, 1, "of the transmitter; 0: none"}, self.resolution_K);
  }
};

inline TransducerErrors errors(const Thermometer& thermometer) {
  return {.offset = thermometer.offset_K,
          .time_constant_s = thermometer.time_constant_s,
          .noise = thermometer.noise_K,
          .resolution = thermometer.resolution_K};
}

}  // namespace spoolflow::rig
