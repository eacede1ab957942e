#pragma once
/// Where the model was calibrated, and where the runs used it.
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/run_result.hpp"

namespace spoolflow::report {

/// Position against pressure difference, flow and current, and the oil temperatures; what lies outside is shaded.
[[nodiscard]] std::vector<CaptionedFigure> envelope_figures(const model::Model& model,
                                                            const std::vector<validation::RunResult>& runs);

/// A section with them; nothing without runs.
void show_envelope(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs);

}  // namespace spoolflow::report
