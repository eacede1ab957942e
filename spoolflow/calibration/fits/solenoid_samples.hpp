#pragma once
/// A solenoid recording as the samples that the sensor will see, with the load cell beside them.
#include <string>
#include <vector>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/basis/sample.hpp"

namespace spoolflow::calibration {

/// How a recorder took current and voltage: at the sample's instant, or as a mean over the time since the sample
/// before.
enum class Sampling { instant, mean };

struct SolenoidSamples {
  std::string file;
  std::vector<sensor::Sample<double>> samples;  ///< current and voltage as means over the step; NaN voltage: absent
  std::vector<double> time_s;
  std::vector<double> force_N;
  std::vector<int> test;       ///< number of the protocol's part; 0 where the recording does not state it
  std::vector<char> restarts;  ///< 1 where the armature was moved and the coil starts again
  Sampling sampling = Sampling::mean;

  [[nodiscard]] std::size_t size() const { return samples.size(); }
  [[nodiscard]] bool has_voltage() const { return voltage_measured; }
  bool voltage_measured = false;
};

/// Needs `current`, `position` and `force`; samples in which one of them is missing are left out. `stroke_m`
/// distinguishes a moved armature from noise.
[[nodiscard]] SolenoidSamples solenoid_samples(const recording::Recording& recording, double stroke_m,
                                               Sampling sampling);

/// Means over consecutive samples, as long as the current changes by less than `current_step_A` and the step stays
/// below 2 ms: fast recordings of slow signals without their weight.
[[nodiscard]] SolenoidSamples thinned(const SolenoidSamples& samples, double current_step_A);

}  // namespace spoolflow::calibration
