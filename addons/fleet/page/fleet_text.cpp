#include "addons/fleet/page/fleet_text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "addons/live/http/json_text.hpp"
#include "addons/live/page/alarm_text.hpp"
#include "spoolflow/sensor/basis/status.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::fleet {
namespace {

using live::Json;
using live::rounded;
using live::written;

constexpr std::size_t most_outliers = 100;

Json litres(double m3_per_s) {
  if (!std::isfinite(m3_per_s)) return nullptr;
  return rounded(m3_per_s * units::litre_per_minute_per_m3_per_s, 4);
}

Json six_digits(double value) {
  if (!std::isfinite(value)) return nullptr;
  return Json::parse(fmt::format("{:.6g}", value));
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Json status_of(std::uint32_t bits) {
  const auto status = static_cast<sensor::Status>(bits);
  Json out = Json::array();
  for (const sensor::StatusName& entry : sensor::status_names) {
    if (sensor::has(status, entry.bit)) out.push_back(entry.name);
  }
  if (sensor::has(status, sensor::monitor_status_name.bit)) out.push_back(sensor::monitor_status_name.name);
  return out;
}

Json valve_of(const ShownValve& valve) {
  const live::Summary& last = valve.now.last;
  return {{"id", valve.now.id},
          {"site", valve.site},
          {"series", valve.series},
          {"time", live::utc(valve.now.wall_ms)},
          {"age_s", rounded(valve.now.age_s, 1)},
          {"silent", valve.silent()},
          {"flow_L_min", litres(last.flow_mean_m3_per_s)},
          {"flow_lower_L_min", litres(last.lower_min_m3_per_s)},
          {"flow_upper_L_min", litres(last.upper_max_m3_per_s)},
          {"status", status_of(last.status)},
          {"ne107", valve.sign},
          {"alarms", valve.alarms},
          {"unacknowledged", valve.unacknowledged},
          {"samples", valve.now.samples},
          {"energy_J", rounded(valve.now.energy_J, 1)}};
}

Json keyed(const live::Alarm& alarm) {
  Json out = live::json_of(alarm);
  out["key"] = fmt::format("{}/{}", alarm.valve, alarm.id);
  return out;
}

Json outliers_of(const Distribution& one) {
  struct Found {
    const Distribution::Row* row;
    double score;
  };
  std::vector<Found> found;
  for (const Distribution::Row& row : one.rows) {
    if (is_outlier(one.spread, row.figure)) found.push_back({&row, score(one.spread, row.figure)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return std::abs(a.score) > std::abs(b.score); });
  Json named = Json::array();
  for (std::size_t k = 0; k < std::min(found.size(), most_outliers); ++k) {
    named.push_back({{"valve", found[k].row->valve},
                     {"value", six_digits(found[k].row->figure.value)},
                     {"uncertainty_95", six_digits(found[k].row->figure.uncertainty_95)},
                     {"score", rounded(found[k].score, 2)}});
  }
  return {{"count", found.size()}, {"named", std::move(named)}};
}

}  // namespace

std::string valves_json(const std::vector<ShownValve>& valves, const ValveFilter& filter) {
  Json out = Json::array();
  const std::string search = lower(filter.search);
  for (const ShownValve& valve : valves) {
    if (!filter.site.empty() && valve.site != filter.site) continue;
    if (!filter.series.empty() && valve.series != filter.series) continue;
    if (!search.empty() && lower(valve.now.id).find(search) == std::string::npos) continue;
    out.push_back(valve_of(valve));
  }
  return written(Json{{"valves", std::move(out)}});
}

std::string sites_json(const std::vector<ShownSite>& sites) {
  Json out = Json::array();
  for (const ShownSite& site : sites) {
    Json signs = Json::object();
    for (const char* sign : {"good", "M", "S", "C", "F"})
      signs[sign] = site.signs.contains(sign) ? site.signs.at(sign) : 0;
    out.push_back({{"site", site.site},
                   {"valves", site.valves},
                   {"silent", site.silent},
                   {"ne107", std::move(signs)},
                   {"alarms", site.alarms},
                   {"unacknowledged", site.unacknowledged},
                   {"flow_L_min", litres(site.flow_m3_per_s)}});
  }
  return written(Json{{"sites", std::move(out)}});
}

std::string alarm_json(const live::Alarm& alarm) {
  return written(keyed(alarm));
}

std::string alarms_json(const std::vector<live::Alarm>& alarms) {
  Json out = Json::array();
  for (const live::Alarm& alarm : alarms) out.push_back(keyed(alarm));
  return written(Json{{"alarms", std::move(out)}});
}

std::string events_json(const std::vector<live::Event>& events) {
  Json out = Json::array();
  for (const live::Event& event : events) {
    out.push_back({{"id", event.id},
                   {"time", live::utc(event.wall_ms)},
                   {"valve", event.valve},
                   {"time_s", rounded(event.time_s, 6)},
                   {"kind", event.kind},
                   {"text", event.text}});
  }
  return written(Json{{"events", std::move(out)}});
}

std::string series_json(const Distributions& distributions) {
  Json series = Json::array();
  for (const auto& [name, one] : distributions) {
    if (series.empty() || series.back()["series"] != name.first)
      series.push_back({{"series", name.first}, {"indicators", Json::array()}});
    series.back()["indicators"].push_back({{"name", name.second},
                                           {"unit", one.unit},
                                           {"valves", one.spread.valves},
                                           {"median", six_digits(one.spread.median)},
                                           {"scale", six_digits(one.spread.scale)},
                                           {"outliers", outliers_of(one)}});
  }
  return written(Json{{"series", std::move(series)}});
}

std::string distribution_json(const Distribution& one) {
  Json valves = Json::array(), values = Json::array(), uncertain = Json::array(), scores = Json::array(),
       outlying = Json::array();
  for (const Distribution::Row& row : one.rows) {
    valves.push_back(row.valve);
    values.push_back(six_digits(row.figure.value));
    uncertain.push_back(six_digits(row.figure.uncertainty_95));
    scores.push_back(rounded(score(one.spread, row.figure), 2));
    outlying.push_back(is_outlier(one.spread, row.figure));
  }
  return written(Json{{"unit", one.unit},
                      {"median", six_digits(one.spread.median)},
                      {"scale", six_digits(one.spread.scale)},
                      {"valve", std::move(valves)},
                      {"value", std::move(values)},
                      {"uncertainty_95", std::move(uncertain)},
                      {"score", std::move(scores)},
                      {"outlier", std::move(outlying)}});
}

std::string partitions_json(const std::vector<PartitionStatus>& partitions) {
  Json out = Json::array();
  for (const PartitionStatus& one : partitions) {
    const bool held = !one.owner.empty() && one.lease_s > 0;
    out.push_back({{"partition", one.number},
                   {"epoch", one.epoch},
                   {"valves", one.valves},
                   {"blocks", one.blocks},
                   {"set_aside", one.set_aside},
                   {"behind_s", one.valves == 0 ? Json(nullptr) : rounded(one.behind_s, 1)},
                   {"owner", held ? Json(one.owner) : Json(nullptr)}});
  }
  return written(Json{{"partitions", std::move(out)}});
}

std::string metrics_text(const std::vector<ShownSite>& sites, const std::vector<PartitionStatus>& partitions) {
  std::string out;
  const auto family = [&](const char* name, const char* help, auto&& value) {
    out += fmt::format("# HELP {0} {1}\n# TYPE {0} gauge\n", name, help);
    for (const ShownSite& site : sites) out += fmt::format("{}{{site=\"{}\"}} {}\n", name, site.site, value(site));
  };
  family("spoolflow_fleet_valves", "Valves that the fleet has met.", [](const ShownSite& s) { return s.valves; });
  family("spoolflow_fleet_silent", "Valves without a committed block for 30 s.",
         [](const ShownSite& s) { return s.silent; });
  family("spoolflow_fleet_not_good", "Valves with an alarm that is not gone.",
         [](const ShownSite& s) { return s.valves - (s.signs.contains("good") ? s.signs.at("good") : 0); });
  family("spoolflow_fleet_alarms_raised", "Alarms that are not gone.", [](const ShownSite& s) { return s.alarms; });
  family("spoolflow_fleet_alarms_unacknowledged", "Alarms that nobody has acknowledged.",
         [](const ShownSite& s) { return s.unacknowledged; });
  family("spoolflow_fleet_flow_cubic_metres_per_second", "Sum of the mean flow rates of the last blocks.",
         [](const ShownSite& s) { return s.flow_m3_per_s; });
  const auto idle = std::count_if(partitions.begin(), partitions.end(),
                                  [](const PartitionStatus& one) { return one.owner.empty() || one.lease_s <= 0; });
  out += fmt::format(
      "# HELP spoolflow_fleet_partitions_idle Partitions that no worker holds.\n"
      "# TYPE spoolflow_fleet_partitions_idle gauge\nspoolflow_fleet_partitions_idle {}\n",
      idle);
  out +=
      "# HELP spoolflow_fleet_blocks_set_aside_total Blocks of which nothing was made, repeated ones included.\n"
      "# TYPE spoolflow_fleet_blocks_set_aside_total counter\n";
  for (const PartitionStatus& one : partitions) {
    out += fmt::format("spoolflow_fleet_blocks_set_aside_total{{partition=\"{}\"}} {}\n", one.number, one.set_aside);
  }
  return out;
}

}  // namespace spoolflow::fleet
