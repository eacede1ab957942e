#pragma once
#include <vector>

#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/run_result.hpp"

namespace spoolflow::report {

/// How fast the estimate follows: response to the run's steps, and over frequency; what the run does not show is left
/// out.
[[nodiscard]] std::vector<CaptionedFigure> dynamics_figures(const validation::RunResult& run);

}  // namespace spoolflow::report
