#pragma once
/// Tables and bars of uncertainty budgets.
#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/page/html_table.hpp"

namespace spoolflow::report {

/// Every line of one budget, with units and sources.
[[nodiscard]] HtmlTable budget_table(const uncertainty::Budget& budget);

/// One line a point: flow, uncertainty, and what Monte Carlo says of it where trials were made.
[[nodiscard]] HtmlTable points_table(const std::vector<analysis::PointResult>& points, double full_scale_m3_per_s);

/// Magnitudes of the contributions at one point, the largest first; those below a hundredth of the largest left out.
[[nodiscard]] BarChart contribution_chart(const analysis::PointResult& result);

/// Mean shares of the variance over the points.
[[nodiscard]] BarChart share_chart(const std::vector<analysis::GroupShare>& shares, estimation::Estimator estimator);

}  // namespace spoolflow::report
