#pragma once
#include "spoolflow/report/page/html_table.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// A row for each run and estimator: errors in % FS by what the spool did, and the band.
[[nodiscard]] HtmlTable results_table(const validation::Validation& validation, double full_scale_m3_per_s);
/// Every figure of every run, estimator and phase, in L/min and in % FS.
[[nodiscard]] HtmlTable all_figures_table(const validation::Validation& validation, double full_scale_m3_per_s);
/// How often which estimator said what of itself.
[[nodiscard]] HtmlTable status_table(const validation::Validation& validation);

}  // namespace spoolflow::report
