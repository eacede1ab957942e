#include "spoolflow/report/json/monitor_json.hpp"

#include <ostream>

#include <nlohmann/json.hpp>

#include "spoolflow/monitor/baseline_json.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;  // writes null for what is no number

Json indicators_json(const std::vector<monitor::Indicator>& indicators) {
  Json out = Json::array();
  for (const monitor::Indicator& indicator : indicators) {
    out.push_back({{"name", indicator.name},
                   {"value", indicator.value},
                   {"unit", indicator.unit},
                   {"uncertainty_95", indicator.uncertainty_95},
                   {"baseline", indicator.baseline},
                   {"state", monitor::name(indicator.state)}});
  }
  return out;
}

}  // namespace

void write_monitor_json(std::ostream& out, const model::Model& model, const monitor::Watch& watch,
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
            {"model_doubt",
             {{"raised", watch.doubt().any()},
              {"share_of_time", doubt.samples > 0 ? doubt.doubted / doubt.samples : 0.0},
              {"band_factor", doubt.told_m3_per_s > 0 ? doubt.widened_m3_per_s / doubt.told_m3_per_s : 1.0}}},
            {"runs", each},
            {"baseline", Json::parse(monitor::baseline_text(watch.learnt()))}};
  out << json.dump(1) << '\n';
}

}  // namespace spoolflow::report
