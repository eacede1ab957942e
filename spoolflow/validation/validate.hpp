#pragma once
/// One recording through one or several estimators, with figures where it has a reference flow.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/validation/estimation.hpp"
#include "spoolflow/validation/metrics.hpp"

namespace spoolflow::validation {

struct ValidationOptions {
  std::vector<Estimator> estimators;
  recording::ChannelMap channels;
  double reference_lag_s = 0.03;     ///< of the reference meter
  bool apply_reference_lag = false;  ///< lag the estimate likewise before comparing
};

/// Share of the samples with a status bit.
struct StatusShare {
  std::string name;
  double share;
};

/// What one estimator answered over the run; SI.
struct EstimatorResult {
  Estimator estimator;
  std::vector<double> flow_m3_per_s, lower_m3_per_s, upper_m3_per_s, pressure_difference_Pa;
  std::vector<double> magnetic_force_N, spring_force_N, flow_force_N, friction_force_N;
  std::vector<StatusShare> status;  ///< bits that occurred, most frequent first
  std::optional<Metrics> metrics;   ///< absent without reference flow
};

struct ValidatedRun {
  std::string name;  ///< file name without its ending
  std::string file;
  std::vector<double> time_s, position_m, oil_temperature_K;
  std::vector<double> reference_m3_per_s, reference_pressure_difference_Pa;  ///< empty where not recorded
  Phases phases;
  std::vector<EstimatorResult> results;  ///< in the order of the options
  recording::ReadNotes notes;
};

/// `progress` is told the share of the recording that was read. Throws RecordingError and ModelError.
[[nodiscard]] ValidatedRun validate_run(const model::Model& model, const std::filesystem::path& recording,
                                        const ValidationOptions& options, const std::function<void(double)>& progress);

}  // namespace spoolflow::validation
