#pragma once
/// Judged runs, drawn: each by itself, all of them together, and where the model was calibrated.
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/run_result.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// Measured and estimated flow with its band, error, pressure difference, position and status over time (paper Figs 9
/// and 10).
[[nodiscard]] CaptionedFigure run_figure(const validation::RunResult& run, double full_scale_m3_per_s);
/// Its flow alone: measured and estimated, with the band.
[[nodiscard]] CaptionedFigure run_flow_figure(const validation::RunResult& run);
/// The leading estimator's forces over time.
[[nodiscard]] CaptionedFigure force_figure(const validation::RunResult& run);
/// The seconds around the leading estimator's largest error. Needs its `worst`.
[[nodiscard]] CaptionedFigure worst_moment_figure(const validation::RunResult& run, double full_scale_m3_per_s);
/// 95th percentile and median of the error over flow, position, pressure difference and temperature; those with less
/// than three bins are left out.
[[nodiscard]] std::vector<CaptionedFigure> profile_figures(const validation::Validation& validation,
                                                           double full_scale_m3_per_s);

/// A run's trace as web/src/run_data.ts reads it, safe inside a <script> element. Empty where the run has no sample.
[[nodiscard]] std::string trace_json(const validation::RunResult& run, double full_scale_m3_per_s);

/// How fast the estimate follows: response to the run's steps, and over frequency; what the run does not show is left
/// out.
[[nodiscard]] std::vector<CaptionedFigure> dynamics_figures(const validation::RunResult& run);

/// Mean error over position while the spool opens and closes (what is left of hysteresis), and how the errors of
/// estimators and runs are distributed, side by side.
[[nodiscard]] std::vector<CaptionedFigure> direction_and_distribution_figures(const validation::Validation& validation,
                                                                              double full_scale_m3_per_s);

/// Size of the errors by direction of motion.
[[nodiscard]] HtmlTable direction_table(const validation::Validation& validation, double full_scale_m3_per_s);

/// Position against pressure difference, flow and current, and the oil temperatures; what lies outside is shaded.
[[nodiscard]] std::vector<CaptionedFigure> envelope_figures(const model::Model& model,
                                                            const std::vector<validation::RunResult>& runs);

/// A section with them; nothing without runs.
void show_envelope(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs);

}  // namespace spoolflow::report
