#include <ostream>

#include <nlohmann/json.hpp>

#include "spoolflow/model/json_text.hpp"
#include "spoolflow/monitor/baseline.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/json/type_json.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;  // writes null for what is no number

Json trend_json(const monitor::Trend& trend) {
  return {{"per_hour", trend.per_hour},
          {"uncertainty_95", trend.uncertainty_95},
          {"limit", trend.limit},
          {"hours_to_limit", trend.expected_h},
          {"hours_to_limit_95", {trend.earliest_h, trend.latest_h}}};
}

/// Seconds by flow over the rated one (rows) and pressure difference over the calibrated range (columns).
Json load_json(const model::Model& model, const monitor::Usage& usage) {
  constexpr std::size_t classes = monitor::load_classes;
  const double highest_Pa = model.observer->parameters.edge.highest_pressure_difference_Pa();
  Json flow_m3_per_s = Json::array(), pressure_Pa = Json::array(), time_s = Json::array();
  for (std::size_t row = 0; row < classes; ++row) {
    const double share = static_cast<double>(row) / static_cast<double>(classes);
    flow_m3_per_s.push_back(share * model.valve.rated_flow_m3_per_s);
    pressure_Pa.push_back(share * highest_Pa);
    Json line = Json::array();
    for (std::size_t column = 0; column < classes; ++column) line.push_back(usage.load_s[row * classes + column]);
    time_s.push_back(std::move(line));
  }
  return {{"flow_from_m3_per_s", flow_m3_per_s}, {"pressure_difference_from_Pa", pressure_Pa}, {"time_s", time_s}};
}

Json indicators_json(const std::vector<monitor::Indicator>& indicators) {
  Json out = Json::array();
  for (const monitor::Indicator& indicator : indicators) {
    Json one{{"name", indicator.name},         {"value", indicator.value},
             {"unit", indicator.unit},         {"uncertainty_95", indicator.uncertainty_95},
             {"baseline", indicator.baseline}, {"state", monitor::name(indicator.state)}};
    if (indicator.trend.there) one["trend"] = trend_json(indicator.trend);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

void write_monitor_json(std::ostream& out, const model::Model& model, const monitor::Monitor& watch,
                        const std::vector<MonitoredRun>& runs, const DoubtFigures& doubt) {
  Json causes = Json::array();
  for (const monitor::Cause& cause : watch.causes())
    causes.push_back({{"cause", monitor::name(cause.fault)}, {"odds", cause.odds}});
  Json each = Json::array();
  for (const MonitoredRun& run : runs)
    each.push_back(
        {{"run", run.name}, {"ne107", monitor::name(run.condition)}, {"indicators", indicators_json(run.indicators)}});
  Json json{{"valve", model.valve.name},
            {"ne107", monitor::name(watch.condition())},
            {"causes", causes},
            {"indicators", indicators_json(watch.indicators())},
            {"load_histogram", load_json(model, watch.usage())},
            {"model_doubt",
             {{"raised", watch.doubt().any()},
              {"share_of_time", doubt.samples > 0 ? doubt.doubted / doubt.samples : 0.0},
              {"band_factor", doubt.sensor_m3_per_s > 0 ? doubt.widened_m3_per_s / doubt.sensor_m3_per_s : 1.0}}},
            {"runs", each},
            {"baseline", model::parsed_json(monitor::baseline_text(watch.learnt()), "baseline")}};
  add_type(json, model);
  out << json.dump(1) << '\n';
}

}  // namespace spoolflow::report
