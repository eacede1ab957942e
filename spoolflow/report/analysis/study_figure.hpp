#pragma once
#include "spoolflow/analysis/study.hpp"
#include "spoolflow/report/figures/bar_chart.hpp"

namespace spoolflow::report {

/// Sobol indices of one output as bars with their confidence intervals: total (pale) and first order.
[[nodiscard]] CaptionedChart study_figure(const analysis::Study& study, std::size_t output);

}  // namespace spoolflow::report
