#pragma once
/// What a validation is asked, and what it found.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/validation/requirements.hpp"
#include "spoolflow/validation/run_result.hpp"

namespace spoolflow::validation {

struct ValidationOptions {
  std::vector<estimation::Estimator> estimators;  ///< the leading one last
  recording::ChannelMap channels;
  /// Of the reference meter, without dead time; else dead time and lag are those that each run shows. A run that shows
  /// none takes the median of the other runs.
  std::optional<double> reference_lag_s = {};
  bool apply_reference_lag = true;  ///< lag the estimate likewise before comparing
  /// Numbers that the traces of all runs together may hold: 3.5 million are 9 MiB of the report.
  std::size_t traced_values = 3'500'000;
  std::optional<Requirements> requirements = {};
};

/// One estimator over all runs with reference flow together.
struct PooledResult {
  estimation::Estimator estimator;
  std::optional<Metrics> metrics;      ///< each run weighs alike
  std::optional<Metrics> by_sample;    ///< each sample weighs alike
  std::vector<ErrorProfile> profiles;  ///< one for each of `quantities`
  std::optional<DirectionProfile> direction = {};
  std::optional<SignFigures> sign = {};  ///< of a whole valve
};

struct Validation {
  std::vector<RunResult> runs;
  std::vector<PooledResult> pooled;  ///< in the order of the options; of the runs that the calibration did not know
  double reference_lag_s = 0;        ///< of the runs that show it, the median
  bool reference_lag_applied = false;
  std::string requirements_file;    ///< empty: nothing was asked
  std::vector<JudgedLimit> limits;  ///< in the file's order
  bool held_out = true;             ///< there is a run that the calibration did not know; else all are pooled
};

/// Whether pooled figures hold the run: it has a reference flow, and the calibration did not know it (or knew all).
[[nodiscard]] inline bool is_pooled(const RunResult& run, const Validation& validation) {
  const bool judged = !run.results.empty() && run.results.back().metrics.has_value();
  return judged && (!run.calibrated_with || !validation.held_out);
}
/// Figures of one pooled run are those of the run itself.
[[nodiscard]] inline bool pools_several_runs(const Validation& validation) {
  std::size_t out = 0;
  for (const RunResult& run : validation.runs) out += is_pooled(run, validation) ? 1 : 0;
  return out > 1;
}

}  // namespace spoolflow::validation
