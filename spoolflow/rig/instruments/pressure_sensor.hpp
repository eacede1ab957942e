#pragma once
/// Pressure sensors before and behind the metering edge.
#include "spoolflow/rig/instruments/transducer.hpp"

namespace spoolflow::rig {

struct PressureSensor {
  double gain_error = 0.0;
  double offset_Pa = 0.0;
  double time_constant_s = 1.0e-3;
  double noise_Pa = 0.055e5;
  double resolution_Pa = 100.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "calibrated pairs: within 0.1 %"}, self.gain_error);
    visit(Parameter{"offset_Pa", "Pa", -5e5, 5e5, "0.1 % of a 100 bar range is 0.1 bar"}, self.offset_Pa);
    visit(Parameter{"time_constant_s", "s", 0, 1, "data sheets: 10 to 90 % in 1 to 2 ms"}, self.time_constant_s);
    visit(Parameter{"noise_Pa", "Pa", 0, 5e5, "standard deviation; 0.05 % of a 100 bar range"}, self.noise_Pa);
    visit(Parameter{"resolution_Pa", "Pa", 0, 1e5, "16 bit over 100 bar is 150 Pa; 0: none"}, self.resolution_Pa);
  }
};

inline TransducerErrors errors(const PressureSensor& sensor) {
  return {.gain_error = sensor.gain_error,
          .offset = sensor.offset_Pa,
          .time_constant_s = sensor.time_constant_s,
          .noise = sensor.noise_Pa,
          .resolution = sensor.resolution_Pa};
}

}  // namespace spoolflow::rig
