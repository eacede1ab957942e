#include "spoolflow/report/analysis/analysis_report.hpp"

#include <algorithm>
#include <numeric>
#include <ostream>

#include <fmt/format.h>

#include "spoolflow/report/analysis/analysis_verdict.hpp"
#include "spoolflow/report/analysis/budget_sections.hpp"
#include "spoolflow/report/calibration/model_sections.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using analysis::Analysis;
using analysis::PointResult;
using estimation::Estimator;

const char* const legend_of_kinds =
    "<div class=\"heat\"><span><svg viewBox=\"0 0 16 12\" aria-hidden=\"true\"><rect width=\"16\" height=\"12\" "
    "style=\"fill:var(--observer)\"/></svg>part of the sensor's model</span><span><svg viewBox=\"0 0 16 12\" "
    "aria-hidden=\"true\"><rect width=\"16\" height=\"12\" style=\"fill:var(--condensed)\"/></svg>instrument or "
    "oil</span></div>";

std::vector<Estimator> estimators_of(const Analysis& analysis) {
  std::vector<Estimator> out;
  for (const PointResult& point : analysis.points) {
    if (out.empty() || out.back() != point.estimator) out.push_back(point.estimator);
  }
  return out;
}

/// The reachable point nearest to the middle of an estimator's list; null where there is none.
const PointResult* middle_point(const Analysis& analysis, Estimator estimator) {
  std::vector<const PointResult*> reachable;
  for (const PointResult& point : analysis.points) {
    if (point.estimator == estimator && point.reachable) reachable.push_back(&point);
  }
  return reachable.empty() ? nullptr : reachable[reachable.size() / 2];
}

Text place_of(const PointResult& result) {
  return phrase("{}, {}, {}, {}", fixed(units::length(result.point.position_m), 2),
                fixed(units::pressure(result.point.pressure_difference_Pa), 0),
                fixed(units::temperature(result.point.oil_temperature_K), 0),
                result.point.opening ? "opening" : "closing");
}

void show_budget(HtmlPage& page, const model::Model& model, const Analysis& analysis) {
  page.section("Uncertainty budget");
  page.paragraph(
      "After JCGM 100 (GUM). Every error is put in where it arises and goes through the sensor's own code. "
      "Sensitivities "
      "of the condensed sensor by automatic differentiation, of the observer, which branches on motion, by central "
      "differences over plus and minus one standard uncertainty.");
  std::vector<CaptionedChart> shares;
  for (const Estimator estimator : estimators_of(analysis)) {
    shares.push_back({share_chart(analysis::mean_shares(analysis.points, estimator), estimator),
                      fmt::format("The {}: what makes the variance of its flow rate, mean over the working points.",
                                  sensor_name(estimator))});
  }
  page.html(legend_of_kinds);
  page.pair(shares);
  for (const Estimator estimator : estimators_of(analysis)) {
    const PointResult* const point = middle_point(analysis, estimator);
    if (point == nullptr) continue;
    page.subsection(phrase("The {} at {}", sensor_name(estimator), place_of(*point)));
    page.chart(
        {contribution_chart(*point),
         phrase("Contributions to the standard uncertainty of {} at a flow rate of {}; those below a hundredth of "
                "the largest are in the table only.",
                three_digits(units::flow(point->budget.combined_m3_per_s)),
                fixed(units::flow(point->flow_m3_per_s), 1)),
         legend_of_kinds});
    page.table(budget_table(point->budget));
    if (!point->stated.by_budget) {
      page.note(
          phrase("The trials do not validate this expanded uncertainty: the 95 % interval to state is theirs, "
                 "{} to {}.",
                 bare(fixed(units::flow(point->stated.lower), 2)), fixed(units::flow(point->stated.upper), 2)));
    }
    for (const uncertainty::Correlation& c : point->budget.correlations) {
      page.note(fmt::format("Correlated: {} with {}, r = {}: {}.", uncertainty::about(c.one).title,
                            uncertainty::about(c.other).title, fixed(c.coefficient, 2), c.source));
    }
  }
  page.section("All working points, and the check by Monte Carlo");
  page.paragraph(fmt::format(
      "After JCGM 101: all errors drawn from their distributions, {} trials a point through the same code. "
      "The budget is "
      "validated where both ends of its 95 % interval lie within half a unit of digit {} of the standard "
      "uncertainty of those of the trials (clause 8). Where they do not, the interval stated is that of the "
      "trials, as much probability below it as above: friction of unknown direction is two-valued, and no "
      "multiple of a standard deviation describes that.",
      analysis.points.empty() ? 0 : analysis.points.front().check.figures.trials,
      fixed(analysis.scenario.monte_carlo.digits, 0)));
  page.table(points_table(analysis.points, model.valve.rated_flow_m3_per_s));
}

void show_maps(HtmlPage& page, const model::Model& model, const Analysis& analysis) {
  page.section("Over the operating map");
  page.paragraph("The budget again in every cell, while the spool passes it.");
  for (const analysis::OperatingMap& map : analysis.maps) {
    page.html(operating_map_figures(map, model.valve.rated_flow_m3_per_s, page.units()));
  }
}

/// Sobol indices of one output as bars with their confidence intervals: total (pale) and first order.
CaptionedChart study_figure(const analysis::Study& study, std::size_t output) {
  const analysis::SobolIndices& found = study.indices[output];
  const analysis::StudyOutput& about = analysis::study_output_list()[output];
  std::vector<std::size_t> order(found.factors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return found.factors[a].total.value > found.factors[b].total.value; });
  const std::string error = about.p95 ? "95th percentile of the error" : "RMS error";
  BarChart chart{.description = fmt::format("Sobol indices of the {}'s {}", sensor_name(about.estimator), error),
                 .axis = "Share of the variance from one valve to the next",
                 .bars = {},
                 .lowest = -0.2,
                 .highest = 1.2};
  for (const std::size_t f : order) {
    const analysis::FactorIndices& indices = found.factors[f];
    const analysis::Factor& factor = analysis::valve_factors()[f];
    const auto length = [](const analysis::Index& index) { return Bar::Length{index.value, index.lower, index.upper}; };
    chart.bars.push_back(
        {.name = factor.name,
         .tone = factor.kind == analysis::FactorKind::instrument ? "condensed" : "observer",
         .solid = length(indices.first_order),
         .pale = length(indices.total),
         .text = fmt::format("{} / {}", fixed(indices.first_order.value, 2), fixed(indices.total.value, 2))});
  }
  return {std::move(chart),
          fmt::format("{} of the {}: first-order index (solid; alone) / total index (pale; with all "
                      "interactions), whiskers 95 % confidence. Over the series the error is {} \u00b1 {} % FS "
                      "(mean, standard deviation).",
                      error, sensor_name(about.estimator), fixed(100 * found.mean, 2),
                      fixed(100 * found.standard_deviation, 2))};
}

void show_study(HtmlPage& page, const analysis::Study& study) {
  page.section("From one valve to the next");
  page.paragraph(fmt::format(
      "Global sensitivity (Sobol indices) on the virtual test rig, simulated: {} runs of {} s, a random duty cycle of "
      "{} "
      "with other springs, friction, edges, solenoids, oils and instruments in each. The sensor runs with {}, so that "
      "the "
      "figures say what a sensor loses that was calibrated on one valve and works in another.",
      study.runs, three_digits(study.run_s), study.valve,
      study.given_model ? "the given model" : "the model that calibration makes of the nominal virtual valve"));
  page.html(legend_of_kinds);
  for (const std::size_t output : {std::size_t{2}, std::size_t{0}}) page.chart(study_figure(study, output));
}

}  // namespace

void write_analysis_report(std::ostream& out, const model::Model& model, const Analysis& analysis,
                           const ReaderUnits& units) {
  HtmlPage page("spoolflow analysis report",
                "Uncertainty of the flow rate of " + model.valve.name + ", f" + std::string(flow_name(model)).substr(1),
                origin_of(model), units);
  page.headline(headline_of(model));
  const AnalysisVerdict verdict = analysis_verdict(model, analysis);
  page.verdict(verdict.sentence);
  page.remarks(std::vector<Text>(verdict.remarks.begin(), verdict.remarks.end()));
  show_budget(page, model, analysis);
  show_maps(page, model, analysis);
  if (analysis.run) show_run_budget(page, *analysis.run, model.valve.rated_flow_m3_per_s);
  if (analysis.study) show_study(page, *analysis.study);
  show_inputs(page, model, {});
  out << page.str();
}

}  // namespace spoolflow::report
