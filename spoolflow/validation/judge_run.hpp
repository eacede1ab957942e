#pragma once
#include "spoolflow/validation/run_result.hpp"
#include "spoolflow/validation/run_samples.hpp"
#include "spoolflow/validation/validation.hpp"

namespace spoolflow::validation {

/// A run's result, and per estimator the samples behind its figures, so that several runs can be pooled.
struct JudgedRun {
  RunResult result;
  std::vector<ComparedSamples> compared;  ///< empty without reference flow
};

/// A profile without samples for each of `quantities`.
[[nodiscard]] std::vector<ErrorProfile> empty_profiles(const model::Valve& valve);
[[nodiscard]] DirectionProfile empty_direction(const model::Valve& valve);

/// Compares what the estimators answered with the reference. Lags `run`'s answers as `meter` does first where the
/// options ask for it. `traced_values`: the most numbers in the run's trace.
[[nodiscard]] JudgedRun judge_run(const model::Valve& valve, RunSamples& run, const KnownMeter& meter,
                                  const ValidationOptions& options, std::size_t traced_values);

}  // namespace spoolflow::validation
