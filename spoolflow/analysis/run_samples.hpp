#pragma once
#include <string>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::analysis {

/// A recording as the sensor meets it, and the instants at which the budget looks at it: evenly over the samples.
struct RunSamples {
  std::string name;
  std::vector<estimation::TimedSample> samples;
  std::vector<double> reference_m3_per_s;  ///< empty where no flow was recorded; NaN: missing
  std::vector<std::size_t> instants;       ///< rising indices of complete samples
};

inline constexpr std::size_t most_instants = 4000;

/// Throws RecordingError where no sample has both current and position.
[[nodiscard]] RunSamples run_samples(const recording::Recording& recording);

}  // namespace spoolflow::analysis
