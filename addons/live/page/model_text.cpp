#include "addons/live/page/model_text.hpp"

#include "addons/live/http/json_text.hpp"
#include "spoolflow/monitor/adaptation.hpp"

namespace spoolflow::live {
namespace {

Json rate_of(const monitor::WearRate& rate) {
  return {{"value", rate.value}, {"uncertainty_95", rate.uncertainty_95}};
}

Json drift_of(const model::Provenance& provenance, const std::string& direction) {
  const auto drift = monitor::wear_drift(provenance, direction);
  if (!drift) return nullptr;
  return {{"edge_width", rate_of(drift->edge_width)},
          {"friction", rate_of(drift->friction)},
          {"position_zero_m", rate_of(drift->position_zero_m)},
          {"looks", drift->looks},
          {"days", drift->days}};
}

/// Newest first.
Json references_of(const model::Provenance& provenance) {
  Json out = Json::array();
  for (auto each = provenance.adaptations.rbegin(); each != provenance.adaptations.rend(); ++each) {
    if (!each->wear) continue;
    out.push_back({{"time", each->created},
                   {"recordings", each->files},
                   {"reasons", each->reasons},
                   {"edge_width", each->wear->edge_width},
                   {"friction_ratio", each->wear->friction_ratio},
                   {"position_zero_m", each->wear->position_zero_m}});
    if (!each->direction.empty()) out.back()["direction"] = each->direction;
  }
  return out;
}

}  // namespace

std::string model_json(const Engine& engine, std::size_t valve) {
  const SharedModel& of = engine.site().valves[valve].model;
  const model::Provenance& provenance = of.model->provenance;
  const bool whole = of.model->whole();
  Json out{{"valve", engine.valve(valve).id()},
           {"file", of.file.filename().string()},
           {"sha256", of.sha256},
           {"tool", provenance.tool_version},
           {"calibrated", provenance.created},
           {"simulated", provenance.simulated},
           {"references", references_of(provenance)},
           {"drift_in_30_days", drift_of(provenance, whole ? "b" : "")}};
  if (whole) out["drift_in_30_days_p_to_a"] = drift_of(provenance, "a");
  return written(out);
}

}  // namespace spoolflow::live
