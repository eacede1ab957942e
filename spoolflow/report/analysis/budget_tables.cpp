#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/analysis/budget_sections.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using units::Kind;

/// In the reader's unit where the input is of a kind that has a choice, else in its own ("%", "um").
Text size_text(const uncertainty::QuantityAbout& about, double value_SI) {
  if (const std::optional<Kind> kind = units::kind_in(about.unit))
    return three_digits(units::Quantity{*kind, value_SI});
  return three_digits(value_SI * about.per_SI) + " " + (about.unit == "um" ? "\u00b5m" : std::string(about.unit));
}

/// What the flow changes with one of the unit in which the input's size is written.
Text sensitivity_text(const uncertainty::QuantityAbout& about, double sensitivity_m3_per_s) {
  const std::optional<Kind> kind = units::kind_in(about.unit);
  return Text([=, per_SI = about.per_SI](const ReaderUnits& units) {
    const double written_per_SI = kind ? per_SI * units.unit(*kind).factor : per_SI;
    return bare(three_digits(units::flow(sensitivity_m3_per_s / written_per_SI))).in(units);
  });
}

std::string freedom_text(double degrees_of_freedom) {
  return degrees_of_freedom < 1e4 ? fixed(degrees_of_freedom, 0) : "\u221e";
}

std::string tone_of(bool part_of_model) {
  return part_of_model ? "observer" : "condensed";
}

}  // namespace

HtmlTable budget_table(const uncertainty::Budget& budget) {
  HtmlTable table({{"input", Set::sentence},
                   {"type, distribution", Set::text},
                   {"from", Set::sentence},
                   {"standard<br>uncertainty"},
                   {"sensitivity", Set::number, Kind::flow, "unit"},
                   {"contribution", Set::number, Kind::flow},
                   {"share<br>[%]"},
                   {"degrees of<br>freedom"}});
  for (const uncertainty::BudgetLine& line : budget.lines) {
    const uncertainty::QuantityAbout& about = uncertainty::about(line.input.quantity);
    table.row({html_text(about.title),
               fmt::format("{}, {}", line.input.evaluation == uncertainty::Evaluation::type_a ? "A" : "B",
                           uncertainty::name(line.input.distribution)),
               html_text(line.input.source), size_text(about, line.input.standard_uncertainty),
               sensitivity_text(about, line.sensitivity_m3_per_s),
               three_digits(units::flow(std::abs(line.contribution_m3_per_s))), fixed(100 * line.share, 1),
               freedom_text(line.degrees_of_freedom)});
  }
  table.row({"<b>combined</b>", "",
             phrase("k = {}: expanded uncertainty (95 %) <b>{}</b>", fixed(budget.coverage_factor, 2),
                    three_digits(units::flow(budget.expanded_m3_per_s))),
             "", "", phrase("<b>{}</b>", bare(three_digits(units::flow(budget.combined_m3_per_s)))), "100",
             freedom_text(budget.degrees_of_freedom)},
            true);
  return table;
}

HtmlTable points_table(const std::vector<analysis::PointResult>& points, double full_scale_m3_per_s) {
  const bool any_tried = std::ranges::any_of(points, [](const auto& point) { return point.check.figures.trials > 0; });
  std::vector<HtmlTable::Column> columns{{"estimator", Set::text},
                                         {"position", Set::number, Kind::length},
                                         {"pressure<br>difference", Set::number, Kind::pressure},
                                         {"flow rate", Set::number, Kind::flow},
                                         {"standard", Set::number, Kind::flow},
                                         {"k"},
                                         {"expanded", Set::number, Kind::flow},
                                         {"expanded<br>[% FS]"}};
  if (any_tried) {
    columns.push_back({"deviation of the trials<br>over the budget's"});
    columns.push_back({"95 % interval<br>stated", Set::number, Kind::flow});
    columns.push_back({"by", Set::text});
  }
  HtmlTable table(std::move(columns));
  const estimation::Estimator* before = nullptr;
  for (const analysis::PointResult& result : points) {
    const bool begins = before != nullptr && *before != result.estimator;
    before = &result.estimator;
    std::vector<HtmlTable::Cell> cells{std::string(estimation::name(result.estimator)),
                                       fixed(units::length(result.point.position_m), 2),
                                       fixed(units::pressure(result.point.pressure_difference_Pa), 0)};
    if (!result.reachable) {
      cells.emplace_back("outside");
      table.row(cells, begins);
      continue;
    }
    const uncertainty::Budget& budget = result.budget;
    const auto flow = [](double flow_m3_per_s) { return fixed(units::flow(flow_m3_per_s), 2); };
    const bool tried = result.check.figures.trials > 0;
    for (const HtmlTable::Cell& cell : std::initializer_list<HtmlTable::Cell>{
             flow(result.flow_m3_per_s), flow(budget.combined_m3_per_s), fixed(budget.coverage_factor, 2),
             flow(budget.expanded_m3_per_s), fixed(100 * budget.expanded_m3_per_s / full_scale_m3_per_s, 2),
             tried ? fixed(result.check.comparison.deviation_ratio, 2) : "",
             tried ? phrase("{} to {}", bare(flow(result.stated.lower)), bare(flow(result.stated.upper))) : Text(),
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
  std::ranges::stable_sort(lines, [](const auto& a, const auto& b) {
    return std::abs(a.contribution_m3_per_s) > std::abs(b.contribution_m3_per_s);
  });
  BarChart chart{
      .description = fmt::format("Contributions to the standard uncertainty of the {}", sensor_name(result.estimator)),
      .axis = "Contribution to the standard uncertainty",
      .quantity = Kind::flow,
      .bars = {}};
  const double largest = lines.empty() ? 0 : std::abs(lines.front().contribution_m3_per_s);
  for (const uncertainty::BudgetLine& line : lines) {
    const double size_m3_per_s = std::abs(line.contribution_m3_per_s);
    if (size_m3_per_s < 0.01 * largest || size_m3_per_s == 0) continue;
    const uncertainty::QuantityAbout& about = uncertainty::about(line.input.quantity);
    chart.bars.push_back({.name = std::string(about.title),
                          .tone = tone_of(about.part_of_model),
                          .solid = {size_m3_per_s},
                          .text = bare(three_digits(units::flow(size_m3_per_s)))});
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
