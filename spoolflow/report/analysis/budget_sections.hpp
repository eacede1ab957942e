#pragma once
/// Uncertainty budgets: tables, bars and parts of a page.
#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/analysis/run_analysis.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/page/html_page.hpp"
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

/// How uncertain an estimator is over position and pressure difference, and which group of inputs makes the most of it
/// there: two maps beside each other, as markup.
[[nodiscard]] std::string operating_map_figures(const analysis::OperatingMap& map, double full_scale_m3_per_s,
                                                const ReaderUnits& units);

/// The uncertainty budget in short, for pages about something else: what makes the uncertainty at three levels of
/// pressure, with default figures for the instruments and without Monte Carlo.
void budget_section(HtmlPage& page, const model::Model& model);

/// The budget along a recording: intervals over time, what makes them, and how many samples lie where they should.
void show_run_budget(HtmlPage& page, const analysis::RunAnalysis& run, double full_scale_m3_per_s);

}  // namespace spoolflow::report
