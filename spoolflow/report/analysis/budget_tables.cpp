#include "spoolflow/report/analysis/budget_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/text/sensor_name.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using units::L_per_min_from_m3_per_s;

std::string unit_text(std::string_view unit) {
  return unit == "um" ? "\u00b5m" : std::string(unit);
}

std::string freedom_text(double degrees_of_freedom) {
  return degrees_of_freedom < 1e4 ? fixed(degrees_of_freedom, 0) : "\u221e";
}

std::string tone_of(bool part_of_model) {
  return part_of_model ? "observer" : "condensed";
}

}  // namespace

HtmlTable budget_table(const uncertainty::Budget& budget, const ReaderUnits& units) {
  HtmlTable table({{"input", Set::sentence},
                   {"type, distribution", Set::text},
                   {"from", Set::sentence},
                   {"standard<br>uncertainty"},
                   {"sensitivity<br>[L/min / unit]"},
                   {"contribution<br>[L/min]"},
                   {"share<br>[%]"},
                   {"degrees of<br>freedom"}});
  for (const uncertainty::BudgetLine& line : budget.lines) {
    const uncertainty::QuantityAbout& about = uncertainty::about(line.input.quantity);
    // The table is turned into the reader's units by its headings; what a sensitivity counts per stands in the cells.
    const double per_SI = about.per_SI * units.instead_of(about.unit).factor;
    table.row(
        {html_text(about.title),
         fmt::format("{}, {}", line.input.evaluation == uncertainty::Evaluation::type_a ? "A" : "B",
                     uncertainty::name(line.input.distribution)),
         html_text(line.input.source),
         fmt::format("{} {}", three_digits(line.input.standard_uncertainty * about.per_SI), unit_text(about.unit)),
         three_digits(L_per_min_from_m3_per_s(line.sensitivity_m3_per_s) / per_SI),
         three_digits(L_per_min_from_m3_per_s(std::abs(line.contribution_m3_per_s))), fixed(100 * line.share, 1),
         freedom_text(line.degrees_of_freedom)});
  }
  table.row({"<b>combined</b>", "",
             fmt::format("k = {}: expanded uncertainty (95 %) <b>{} L/min</b>", fixed(budget.coverage_factor, 2),
                         three_digits(L_per_min_from_m3_per_s(budget.expanded_m3_per_s))),
             "", "", fmt::format("<b>{}</b>", three_digits(L_per_min_from_m3_per_s(budget.combined_m3_per_s))), "100",
             freedom_text(budget.degrees_of_freedom)},
            true);
  return table;
}

HtmlTable points_table(const std::vector<analysis::PointResult>& points, double full_scale_m3_per_s) {
  const bool any_tried =
      std::any_of(points.begin(), points.end(), [](const auto& point) { return point.check.figures.trials > 0; });
  std::vector<HtmlTable::Column> columns{{"estimator", Set::text},         {"position<br>[mm]"},
                                         {"pressure<br>difference [bar]"}, {"flow rate<br>[L/min]"},
                                         {"standard<br>[L/min]"},          {"k"},
                                         {"expanded<br>[L/min]"},          {"expanded<br>[% FS]"}};
  if (any_tried) {
    columns.push_back({"deviation of the trials<br>over the budget's"});
    columns.push_back({"95 % interval<br>stated [L/min]"});
    columns.push_back({"by", Set::text});
  }
  HtmlTable table(std::move(columns));
  const estimation::Estimator* before = nullptr;
  for (const analysis::PointResult& result : points) {
    const bool begins = before != nullptr && *before != result.estimator;
    before = &result.estimator;
    std::vector<std::string> cells{std::string(estimation::name(result.estimator)),
                                   fixed(units::mm_from_m(result.point.position_m), 2),
                                   fixed(units::bar_from_Pa(result.point.pressure_difference_Pa), 0)};
    if (!result.reachable) {
      cells.emplace_back("outside");
      table.row(cells, begins);
      continue;
    }
    const uncertainty::Budget& budget = result.budget;
    const auto L_min = [](double m3_per_s) { return fixed(L_per_min_from_m3_per_s(m3_per_s), 2); };
    const bool tried = result.check.figures.trials > 0;
    for (const std::string& cell :
         {L_min(result.flow_m3_per_s), L_min(budget.combined_m3_per_s), fixed(budget.coverage_factor, 2),
          L_min(budget.expanded_m3_per_s), fixed(100 * budget.expanded_m3_per_s / full_scale_m3_per_s, 2),
          tried ? fixed(result.check.comparison.deviation_ratio, 2) : "",
          tried ? fmt::format("{} to {}", L_min(result.stated.lower), L_min(result.stated.upper)) : "",
          std::string(!tried                    ? ""
                      : result.stated.by_budget ? "budget"
                                                : "trials")}) {
      cells.push_back(cell);
    }
    table.row(cells, begins);
  }
  return table;
}

BarChart contribution_chart(const analysis::PointResult& result) {
  std::vector<uncertainty::BudgetLine> lines = result.budget.lines;
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
    return std::abs(a.contribution_m3_per_s) > std::abs(b.contribution_m3_per_s);
  });
  BarChart chart{
      .description = fmt::format("Contributions to the standard uncertainty of the {}", sensor_name(result.estimator)),
      .axis = "Contribution to the standard uncertainty [L/min]",
      .bars = {}};
  const double largest = lines.empty() ? 0 : std::abs(lines.front().contribution_m3_per_s);
  for (const uncertainty::BudgetLine& line : lines) {
    const double size_m3_per_s = std::abs(line.contribution_m3_per_s);
    if (size_m3_per_s < 0.01 * largest || size_m3_per_s == 0) continue;
    const uncertainty::QuantityAbout& about = uncertainty::about(line.input.quantity);
    const double L_min = L_per_min_from_m3_per_s(size_m3_per_s);
    chart.bars.push_back({.name = std::string(about.title),
                          .tone = tone_of(about.part_of_model),
                          .solid = {L_min},
                          .text = three_digits(L_min)});
  }
  return chart;
}

BarChart share_chart(const std::vector<analysis::GroupShare>& shares, estimation::Estimator estimator) {
  BarChart chart{.description = fmt::format("Mean shares of the variance of the {}", sensor_name(estimator)),
                 .axis = "Share of the variance, mean over the points [%]",
                 .bars = {}};
  for (const analysis::GroupShare& group : shares) {
    if (group.share < 5e-4) continue;
    chart.bars.push_back({.name = group.group,
                          .tone = tone_of(group.part_of_model),
                          .solid = {100 * group.share},
                          .text = fixed(100 * group.share, 1)});
  }
  return chart;
}

}  // namespace spoolflow::report
