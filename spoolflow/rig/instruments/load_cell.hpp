#pragma once
/// The bench's load cell between drive and spool or carriage and armature.
#include "spoolflow/rig/instruments/transducer.hpp"

namespace spoolflow::rig {

struct LoadCell {
  double gain_error = 5.0e-4;
  double offset_N = 0.02;
  double time_constant_s = 1.0e-4;
  double noise_N = 0.04;
  double resolution_N = 0.002;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "class 0.1 cells: within 0.1 %"}, self.gain_error);
    visit(Parameter{"offset_N", "N", -5, 5, "after taring: some hundredths of a newton"}, self.offset_N);
    visit(Parameter{"time_constant_s", "s", 0, 1, "bridge amplifier of 1 to 2 kHz"}, self.time_constant_s);
    visit(Parameter{"noise_N", "N", 0, 5, "standard deviation; 0.02 % of a 200 N cell"}, self.noise_N);
    visit(Parameter{"resolution_N", "N", 0, 1, "16 bit over 130 N; 0: none"}, self.resolution_N);
  }
};

inline TransducerErrors errors(const LoadCell& cell) {
  return {.gain_error = cell.gain_error,
          .offset = cell.offset_N,
          .time_constant_s = cell.time_constant_s,
          .noise = cell.noise_N,
          .resolution = cell.resolution_N};
}

}  // namespace spoolflow::rig
