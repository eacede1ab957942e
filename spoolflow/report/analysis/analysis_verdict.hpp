#pragma once
#include <string>
#include <vector>

#include "spoolflow/analysis/analysis.hpp"

namespace spoolflow::report {

/// What to improve next, in plain words; `remarks` say what the figures rest on.
struct AnalysisVerdict {
  std::string sentence;
  std::vector<std::string> remarks;
};
[[nodiscard]] AnalysisVerdict analysis_verdict(const model::Model& model, const analysis::Analysis& analysis);

}  // namespace spoolflow::report
