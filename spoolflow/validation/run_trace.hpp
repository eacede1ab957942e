#pragma once
/// A judged run as an interactive plot shows it: every sample where there is room, else the smallest and the largest
/// value of each stretch of samples, so that no peak is lost.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/validation/run_samples.hpp"

namespace spoolflow::validation {

/// One quantity, one entry a stretch; NaN: nothing known there. `highest` is empty where a stretch is one sample.
struct TracedChannel {
  std::vector<float> lowest, highest;
};

/// What one estimator said; SI. Of the band, the edge that is farther out.
struct TracedEstimator {
  estimation::Estimator estimator;
  TracedChannel flow_m3_per_s, error_m3_per_s, pressure_difference_Pa;
  std::vector<float> lower_m3_per_s, upper_m3_per_s;
  TracedChannel magnetic_force_N, spring_force_N, flow_force_N, friction_force_N;
  /// The forces stacked on each other: spring and flow; spring, flow and friction.
  TracedChannel spring_and_flow_N, all_forces_N;
  /// All that was said in the stretch: bit n is the n-th of the sensor's status names.
  std::vector<std::uint32_t> status;
};

struct RunTrace {
  std::size_t samples_per_stretch = 1;
  /// Of each stretch's first sample. Where nothing was recorded for long, an entry with NaN in all channels stands
  /// between two stretches.
  std::vector<double> time_s;
  /// Empty where not recorded.
  TracedChannel reference_m3_per_s, position_m, pressure_difference_Pa, current_A, voltage_V, oil_temperature_K;
  std::vector<TracedEstimator> estimators;
};

/// At most about `values` numbers in all. Forces are traced for the leading (last) estimator only.
[[nodiscard]] RunTrace run_trace(const RunSamples& run, std::size_t values);

}  // namespace spoolflow::validation
