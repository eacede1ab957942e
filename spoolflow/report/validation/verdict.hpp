#pragma once
/// The judgement in words: how good, and what limits it.
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/report/text/text.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

struct Verdict {
  Text sentence;             ///< the figures
  std::vector<Text> limits;  ///< what limits them, doubts about runs before all, then the most important, at most eight
  std::size_t doubts = 0;    ///< so many of the limits, the first, are doubts about runs
};

[[nodiscard]] Verdict verdict(const model::Model& model, const validation::Validation& validation);
/// Among the runs that are pooled; null where none has a reference flow.
[[nodiscard]] const validation::RunResult* run_of_largest_error(const validation::Validation& validation);
/// The same of a model alone: what was calibrated and how well the maps hold.
[[nodiscard]] Verdict calibration_verdict(const model::Model& model);

/// Lag and dead time of a run's reference meter, with their 95 % uncertainty where the run shows them: "29 ± 2 ms after
/// 0 ± 1 ms of dead time"; and where they are from, if not from the run or the user.
[[nodiscard]] std::string reference_meter_text(const validation::RunResult& run);

}  // namespace spoolflow::report
