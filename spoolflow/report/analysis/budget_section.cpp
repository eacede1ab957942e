
#include <fmt/format.h>

#include "spoolflow/report/analysis/budget_sections.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {
namespace {

/// Budgets alone, at the points that `analyse` takes by default.
std::vector<analysis::PointResult> budgets(const model::Model& model) {
  const analysis::Scenario scenario;
  const uncertainty::InstrumentFigures figures = analysis::instrument_figures(scenario.instruments);
  std::vector<analysis::PointResult> out;
  for (const estimation::Estimator estimator : estimation::all_estimators(model)) {
    const uncertainty::Inputs inputs = uncertainty::inputs_of(model, estimator, figures);
    for (const uncertainty::WorkingPoint& point : analysis::working_points(model, scenario.points)) {
      const auto function = uncertainty::PointFunction::at(model, estimator, point);
      if (!function) continue;
      analysis::PointResult& result = out.emplace_back();
      uncertainty::SeededNumbers none(0, "");
      result.estimator = estimator;
      result.point = point;
      result.reachable = true;
      result.flow_m3_per_s = (*function)({}, none);
      result.budget = function->budget(inputs);
    }
  }
  return out;
}

}  // namespace

void budget_section(HtmlPage& page, const model::Model& model) {
  const std::vector<analysis::PointResult> results = budgets(model);
  if (results.empty()) return;
  page.section("What makes the uncertainty");
  page.paragraph(
      "Budget after JCGM 100 (GUM) while the spool passes the points below, from the model's residuals and stated "
      "defaults for the instruments. The command analyse gives every line with its source, the check by Monte Carlo "
      "and "
      "the sensitivities.");
  std::vector<CaptionedChart> charts;
  for (const estimation::Estimator estimator : estimation::all_estimators(model)) {
    charts.push_back(
        {share_chart(analysis::mean_shares(results, estimator), estimator),
         fmt::format("The {}: share of the variance of its flow rate, mean over the points.", sensor_name(estimator))});
  }
  page.pair(charts);
  page.table(points_table(results, model.valve.rated_flow_m3_per_s));
}

}  // namespace spoolflow::report
