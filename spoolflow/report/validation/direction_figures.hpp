#pragma once
#include <vector>

#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// Mean error over position while the spool opens and closes (what is left of hysteresis), and how the errors of
/// estimators and runs are distributed, side by side.
[[nodiscard]] std::vector<CaptionedFigure> direction_and_distribution_figures(const validation::Validation& validation,
                                                                              double full_scale_m3_per_s);

/// Size of the errors by direction of motion.
[[nodiscard]] HtmlTable direction_table(const validation::Validation& validation, double full_scale_m3_per_s);

}  // namespace spoolflow::report
