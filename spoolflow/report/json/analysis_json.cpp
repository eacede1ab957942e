#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/report/analysis/analysis_verdict.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;  // writes null for what is no number, and for infinity
using units::L_per_min_from_m3_per_s;

Json input(const uncertainty::InputUncertainty& input) {
  const uncertainty::QuantityAbout& about = uncertainty::about(input.quantity);
  return {{"quantity", about.name},
          {"group", about.group},
          {"standard_uncertainty", input.standard_uncertainty * about.per_SI},
          {"unit", about.unit},
          {"type", input.evaluation == uncertainty::Evaluation::type_a ? "A" : "B"},
          {"distribution", uncertainty::name(input.distribution)},
          {"degrees_of_freedom", input.degrees_of_freedom},
          {"source", input.source}};
}

Json lines(const uncertainty::Budget& budget) {
  Json out = Json::array();
  for (const uncertainty::BudgetLine& line : budget.lines) {
    Json entry = input(line.input);
    const double per_SI = uncertainty::about(line.input.quantity).per_SI;
    entry["sensitivity_L_min_per_unit"] = L_per_min_from_m3_per_s(line.sensitivity_m3_per_s) / per_SI;
    entry["contribution_L_min"] = L_per_min_from_m3_per_s(line.contribution_m3_per_s);
    entry["share"] = line.share;
    out.push_back(std::move(entry));
  }
  return out;
}

Json correlations(const uncertainty::Budget& budget) {
  Json out = Json::array();
  for (const uncertainty::Correlation& c : budget.correlations) {
    out.push_back({{"one", uncertainty::about(c.one).name},
                   {"other", uncertainty::about(c.other).name},
                   {"coefficient", c.coefficient},
                   {"source", c.source}});
  }
  return out;
}

Json monte_carlo(const analysis::MonteCarlo& check) {
  const analysis::TrialFigures& figures = check.figures;
  const analysis::Comparison& comparison = check.comparison;
  return {{"trials", figures.trials},
          {"mean_L_min", L_per_min_from_m3_per_s(figures.mean)},
          {"standard_deviation_L_min", L_per_min_from_m3_per_s(figures.standard_deviation)},
          {"standard_error_of_deviation_L_min", L_per_min_from_m3_per_s(figures.standard_error_of_deviation)},
          {"lower_L_min", L_per_min_from_m3_per_s(figures.lower)},
          {"upper_L_min", L_per_min_from_m3_per_s(figures.upper)},
          {"shortest_lower_L_min", L_per_min_from_m3_per_s(figures.shortest_lower)},
          {"shortest_upper_L_min", L_per_min_from_m3_per_s(figures.shortest_upper)},
          {"deviation_over_budget", comparison.deviation_ratio},
          {"lower_difference_L_min", L_per_min_from_m3_per_s(comparison.lower_difference)},
          {"upper_difference_L_min", L_per_min_from_m3_per_s(comparison.upper_difference)},
          {"tolerance_L_min", L_per_min_from_m3_per_s(comparison.tolerance)},
          {"budget_validated", comparison.validated}};
}

Json point(const analysis::PointResult& result, double full_scale_m3_per_s) {
  Json out{{"estimator", estimation::name(result.estimator)},
           {"position_mm", units::mm_from_m(result.point.position_m)},
           {"pressure_difference_bar", units::bar_from_Pa(result.point.pressure_difference_Pa)},
           {"oil_temperature_C", units::degC_from_K(result.point.oil_temperature_K)},
           {"motion", result.point.opening ? "opening" : "closing"},
           {"inside_maps", result.reachable}};
  if (!result.reachable) return out;
  const uncertainty::Budget& budget = result.budget;
  out["current_A"] = result.current_A;
  out["position_reading_mm"] = units::mm_from_m(result.position_reading_m);
  out["flow_L_min"] = L_per_min_from_m3_per_s(result.flow_m3_per_s);
  out["sensitivities_by"] =
      result.estimator == estimation::Estimator::condensed ? "automatic differentiation" : "central differences";
  out["combined_standard_L_min"] = L_per_min_from_m3_per_s(budget.combined_m3_per_s);
  out["effective_degrees_of_freedom"] = budget.degrees_of_freedom;
  out["coverage_factor"] = budget.coverage_factor;
  out["expanded_L_min"] = L_per_min_from_m3_per_s(budget.expanded_m3_per_s);
  out["expanded_percent_FS"] = 100 * budget.expanded_m3_per_s / full_scale_m3_per_s;
  out["budget"] = lines(budget);
  out["correlations"] = correlations(budget);
  out["monte_carlo"] = monte_carlo(result.check);
  out["stated_interval_95"] = {{"lower_L_min", L_per_min_from_m3_per_s(result.stated.lower)},
                               {"upper_L_min", L_per_min_from_m3_per_s(result.stated.upper)},
                               {"by", result.stated.by_budget ? "budget" : "monte_carlo"}};
  return out;
}

Json map(const analysis::OperatingMap& map) {
  Json cells = Json::array();
  const std::size_t columns = map.position_m.size();
  for (std::size_t k = 0; k < map.cells.size(); ++k) {
    const analysis::MapCell& cell = map.cells[k];
    if (!cell.reachable) continue;
    const uncertainty::QuantityAbout& about = uncertainty::about(cell.dominant);
    cells.push_back({{"position_mm", units::mm_from_m(map.position_m[k % columns])},
                     {"pressure_difference_bar", units::bar_from_Pa(map.pressure_difference_Pa[k / columns])},
                     {"flow_L_min", L_per_min_from_m3_per_s(cell.flow_m3_per_s)},
                     {"expanded_L_min", L_per_min_from_m3_per_s(cell.expanded_m3_per_s)},
                     {"dominant", about.name},
                     {"group", about.group},
                     {"share", cell.dominant_share}});
  }
  return {{"estimator", estimation::name(map.estimator)}, {"cells", cells}};
}

Json index(const analysis::Index& index) {
  return {{"value", index.value}, {"lower_95", index.lower}, {"upper_95", index.upper}};
}

Json run_result(const analysis::RunResult& result) {
  Json budget = Json::array();
  for (const analysis::RunLine& line : result.lines) {
    Json entry = input(line.input);
    entry["rms_contribution_L_min"] = L_per_min_from_m3_per_s(line.rms_contribution_m3_per_s);
    entry["share"] = line.share;
    budget.push_back(std::move(entry));
  }
  double squares = 0;
  for (const double u : result.combined_m3_per_s) squares += u * u;
  const double instants = static_cast<double>(result.combined_m3_per_s.size());
  Json out{{"estimator", estimation::name(result.estimator)},
           {"instants", result.time_s.size()},
           {"trials", result.trials},
           {"combined_standard_rms_L_min", L_per_min_from_m3_per_s(std::sqrt(squares / instants))},
           {"coverage_factor", result.coverage_factor},
           {"deviation_over_budget", result.deviation_ratio},
           {"budget", budget}};
  if (result.shares) {
    out["samples_in_band"] = {{"instants_with_reference", result.shares->instants},
                              {"share", result.shares->in_band},
                              {"predicted_by_budget", result.shares->in_band_by_budget},
                              {"predicted_by_trials", result.shares->in_band_by_trials},
                              {"share_in_budget_interval_95", result.shares->in_budget_interval}};
  }
  Json course = Json::array();
  for (std::size_t k = 0; k < result.time_s.size(); ++k) {
    course.push_back({result.time_s[k], L_per_min_from_m3_per_s(result.flow_m3_per_s[k]),
                      L_per_min_from_m3_per_s(result.combined_m3_per_s[k]),
                      L_per_min_from_m3_per_s(result.deviation_m3_per_s[k])});
  }
  out["course_columns"] = {"time_s", "flow_L_min", "combined_standard_L_min", "standard_deviation_of_trials_L_min"};
  out["course"] = std::move(course);
  return out;
}

Json study(const analysis::Study& study) {
  Json outputs = Json::array();
  for (std::size_t o = 0; o < analysis::study_outputs; ++o) {
    const analysis::StudyOutput& output = analysis::study_output_list()[o];
    const analysis::SobolIndices& found = study.indices[o];
    Json factors = Json::array();
    for (std::size_t f = 0; f < found.factors.size(); ++f) {
      const analysis::Factor& factor = analysis::valve_factors()[f];
      factors.push_back({{"factor", factor.name},
                         {"kind", factor.kind == analysis::FactorKind::instrument ? "instrument" : "sub-model"},
                         {"first_order", index(found.factors[f].first_order)},
                         {"total", index(found.factors[f].total)}});
    }
    outputs.push_back({{"estimator", estimation::name(output.estimator)},
                       {"error", output.p95 ? "p95" : "rms"},
                       {"mean_percent_FS", 100 * found.mean},
                       {"standard_deviation_percent_FS", 100 * found.standard_deviation},
                       {"factors", factors}});
  }
  return {{"valve", study.valve},
          {"model", study.given_model ? "MODEL.json" : "calibrated on the virtual valve's own bench"},
          {"base_samples", study.base_samples},
          {"runs", study.runs},
          {"run_s", study.run_s},
          {"outputs", outputs}};
}

}  // namespace

void write_analysis_json(std::ostream& out, const model::Model& model, const analysis::Analysis& analysis) {
  const AnalysisVerdict verdict = analysis_verdict(model, analysis);
  Json file{{"format", "spoolflow analysis"},
            {"version", 1},
            {"valve", model.valve.name},
            {"direction", model.valve.direction},
            {"full_scale_L_min", L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s)},
            {"seed", analysis.scenario.seed},
            {"verdict", verdict.sentence},
            {"remarks", verdict.remarks}};
  Json shares = Json::array();
  for (const auto& group : analysis::mean_shares(analysis.points, analysis::leading_estimator(analysis))) {
    shares.push_back({{"group", group.group}, {"part_of_model", group.part_of_model}, {"mean_share", group.share}});
  }
  file["mean_shares"] = {{"estimator", estimation::name(analysis::leading_estimator(analysis))}, {"groups", shares}};
  Json points = Json::array();
  for (const analysis::PointResult& each : analysis.points)
    points.push_back(point(each, model.valve.rated_flow_m3_per_s));
  file["points"] = std::move(points);
  Json maps = Json::array();
  for (const analysis::OperatingMap& each : analysis.maps) maps.push_back(map(each));
  file["operating_maps"] = std::move(maps);
  if (analysis.run) {
    Json results = Json::array();
    for (const analysis::RunResult& each : analysis.run->results) results.push_back(run_result(each));
    file["run"] = {{"recording", analysis.run->recording}, {"samples", analysis.run->samples}, {"results", results}};
  }
  if (analysis.study) file["study"] = study(*analysis.study);
  out << file.dump(1) << '\n';
}

void write_self_check_json(std::ostream& out, const analysis::SelfCheck& check) {
  Json factors = Json::array();
  for (std::size_t f = 0; f < check.found.factors.size(); ++f) {
    factors.push_back({{"factor", fmt::format("x{}", f + 1)},
                       {"first_order", index(check.found.factors[f].first_order)},
                       {"exact_first_order", check.first_order[f]},
                       {"total", index(check.found.factors[f].total)},
                       {"exact_total", check.total[f]}});
  }
  const Json file{{"format", "spoolflow self-check"},
                  {"version", 1},
                  {"function", "ishigami"},
                  {"base_samples", check.base_samples},
                  {"seed", check.seed},
                  {"passed", check.passed},
                  {"factors", factors}};
  out << file.dump(1) << '\n';
}

}  // namespace spoolflow::report
