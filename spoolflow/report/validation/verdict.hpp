#pragma once
/// The judgement in words: how good, and what limits it.
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/report/text/text.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

struct Verdict {
  Text sentence;             ///< the figures
  std::vector<Text> limits;  ///< what limits them, doubts about runs before all, then the most telling, at most seven
};

[[nodiscard]] Verdict verdict(const model::Model& model, const validation::Validation& validation);
/// The same of a model alone: what was calibrated and how well the maps hold.
[[nodiscard]] Verdict calibration_verdict(const model::Model& model);

}  // namespace spoolflow::report
