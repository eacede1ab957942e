#pragma once
/// A judged run, drawn.
#include "spoolflow/report/page/html_page.hpp"
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

}  // namespace spoolflow::report
