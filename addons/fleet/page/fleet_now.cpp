#include "addons/fleet/page/fleet_now.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "addons/fleet/subjects.hpp"

namespace spoolflow::fleet {

int severity(std::string_view sign) {
  constexpr std::array<std::string_view, 5> signs{"good", "M", "S", "C", "F"};
  return static_cast<int>(std::find(signs.begin(), signs.end(), sign) - signs.begin()) % 5;
}

std::vector<ShownValve> shown_valves(std::vector<ValveNow> valves, const std::vector<live::Alarm>& alarms,
                                     const std::map<std::string, std::string>& series) {
  std::vector<ShownValve> out;
  out.reserve(valves.size());
  std::unordered_map<std::string, std::size_t> places;
  for (ValveNow& now : valves) {
    places[now.id] = out.size();
    const auto known = series.find(now.model_sha256);
    ShownValve one{.now = std::move(now)};
    one.site = site_of(one.now.id);
    // A model that cannot be read still makes a series of its own.
    one.series = known != series.end() ? known->second : "model " + one.now.model_sha256.substr(0, 8);
    out.push_back(std::move(one));
  }
  for (const live::Alarm& alarm : alarms) {
    const auto place = places.find(alarm.valve);
    if (place == places.end()) continue;
    ShownValve& valve = out[place->second];
    const bool counts = alarm.shelved_until_ms == 0;
    if (counts && alarm.acknowledged_ms == 0) ++valve.unacknowledged;
    if (alarm.gone_ms != 0) continue;
    if (counts) ++valve.alarms;
    if (severity(alarm.sign) > severity(valve.sign)) valve.sign = alarm.sign;
  }
  return out;
}

std::vector<ShownSite> shown_sites(const std::vector<ShownValve>& valves) {
  std::map<std::string, ShownSite> sites;
  for (const ShownValve& valve : valves) {
    ShownSite& site = sites[valve.site];
    site.site = valve.site;
    ++site.valves;
    ++site.signs[valve.sign];
    site.alarms += valve.alarms;
    site.unacknowledged += valve.unacknowledged;
    if (valve.silent()) {
      ++site.silent;
    } else if (std::isfinite(valve.now.last.flow_mean_m3_per_s)) {
      site.flow_m3_per_s += valve.now.last.flow_mean_m3_per_s;
    }
  }
  std::vector<ShownSite> out;
  for (auto& [name, site] : sites) out.push_back(std::move(site));
  return out;
}

Distributions distributions(const std::vector<ShownValve>& valves, const std::vector<IndicatorNow>& indicators) {
  std::unordered_map<std::int64_t, const ShownValve*> of;
  for (const ShownValve& valve : valves) of[valve.now.number] = &valve;
  Distributions out;
  for (const IndicatorNow& one : indicators) {
    const auto valve = of.find(one.valve);
    const live::KeptIndicator& kept = one.indicator;
    if (valve == of.end() || kept.state == "counts" || !std::isfinite(kept.value)) continue;
    Distribution& of_series = out[{valve->second->series, kept.name}];
    of_series.unit = kept.unit;
    of_series.rows.push_back({valve->second->now.id, {kept.value, kept.uncertainty_95}, kept.state});
  }
  for (auto& [name, one] : out) {
    std::vector<ValveFigure> figures;
    for (const Distribution::Row& row : one.rows) figures.push_back(row.figure);
    one.spread = spread_of(figures);
  }
  return out;
}

}  // namespace spoolflow::fleet
