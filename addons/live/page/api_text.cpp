#include "addons/live/page/api_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "addons/live/http/json_text.hpp"
#include "spoolflow/monitor/indicators.hpp"
#include "spoolflow/sensor/basis/status.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::live {
namespace {

using units::litre_per_minute_per_m3_per_s;

Json status_of(const ValveView& valve, const SourceView& source) {
  Json out = Json::array();
  for (const sensor::StatusName& entry : sensor::status_names) {
    if (sensor::has(valve.answer.status, entry.bit)) out.push_back(entry.name);
  }
  if (sensor::has(valve.answer.status, sensor::monitor_status_name.bit))
    out.push_back(sensor::monitor_status_name.name);
  if (source.stalled) out.push_back("stalled");
  return out;
}

Json source_of(const SourceView& source) {
  const IntakeCounters& counted = source.counters;
  Json out{{"kind", source.kind},
           {"stalled", source.stalled},
           {"age_s", rounded(source.age_s, 3)},
           {"trouble", source.trouble},
           {"received", counted.received},
           {"dropped", counted.dropped},
           {"lost", counted.lost},
           {"repeated", counted.repeated},
           {"unreadable", counted.unreadable},
           {"connections", counted.connections}};
  if (source.port != 0) out["port"] = source.port;
  return out;
}

Json causes_of(const ValveView& valve) {
  Json out = Json::array();
  for (const monitor::Cause& cause : valve.causes) {
    out.push_back({{"cause", monitor::name(cause.fault)}, {"odds", cause.odds}});
  }
  return out;
}

Json trend_of(const monitor::Trend& trend) {
  if (!trend.there) return nullptr;
  return {{"per_hour", trend.per_hour},
          {"uncertainty_95", trend.uncertainty_95},
          {"limit", trend.limit},
          {"hours_to_limit", trend.expected_h},
          {"hours_to_limit_95", {trend.earliest_h, trend.latest_h}}};
}

Json indicators_of(const ValveView& valve) {
  Json out = Json::array();
  for (const monitor::Indicator& one : valve.indicators) {
    const monitor::AlarmLimits limits = monitor::alarm_limits(one);
    out.push_back({{"name", one.name},
                   {"value", one.value},
                   {"unit", one.unit},
                   {"uncertainty_95", one.uncertainty_95},
                   {"baseline", one.baseline},
                   {"alarm_below", limits.below},
                   {"alarm_above", limits.above},
                   {"trend", trend_of(one.trend)},
                   {"state", monitor::name(one.state)}});
  }
  return out;
}

Json valve_of(const Engine& engine, std::size_t k) {
  const ValveView valve = engine.view(k);
  const SourceView source = engine.source(k);
  const bool known = std::isfinite(valve.time_s);
  const auto answered = [&](double value, int digits) { return known ? rounded(value, digits) : Json(nullptr); };
  const auto flow = [&](double m3_per_s) { return answered(m3_per_s * litre_per_minute_per_m3_per_s, 6); };
  return {{"id", valve.id},
          {"time_s", rounded(valve.time_s, 6)},
          {"flow_L_min", flow(valve.answer.flow_m3_per_s)},
          {"flow_lower_L_min", flow(valve.answer.flow_lower_m3_per_s)},
          {"flow_upper_L_min", flow(valve.answer.flow_upper_m3_per_s)},
          {"pressure_difference_bar", answered(valve.answer.pressure_difference_Pa / units::pascal_per_bar, 4)},
          {"rated_flow_L_min", rounded(valve.rated_flow_m3_per_s * litre_per_minute_per_m3_per_s, 6)},
          {"status", status_of(valve, source)},
          {"ne107", monitor::name(valve.condition)},
          {"causes", causes_of(valve)},
          {"samples", valve.samples},
          {"energy_J", valve.energy_J},
          {"indicators", indicators_of(valve)},
          {"findings", source.findings},
          {"source", source_of(source)}};
}

/// The names of the status word's bits.
Json status_bits() {
  Json out = Json::object();
  for (const sensor::StatusName& entry : sensor::status_names)
    out[std::string(entry.name)] = static_cast<std::uint32_t>(entry.bit);
  out[std::string(sensor::monitor_status_name.name)] = static_cast<std::uint32_t>(sensor::monitor_status_name.bit);
  return out;
}

/// Who sends samples of no valve of the site.
Json unknown_of(const std::vector<UnknownSender>& senders, const char* pieces) {
  Json out = Json::array();
  for (const UnknownSender& one : senders) {
    out.push_back({{"valve", one.valve},
                   {"sender", one.sender},
                   {"first", utc(one.first_ms)},
                   {"last", utc(one.last_ms)},
                   {pieces, one.pieces}});
  }
  return out;
}

/// Of the broker that samples come from.
Json mqtt_source_of(const Engine& engine) {
  if (engine.messages() == nullptr) return nullptr;
  const MessageCounters counters = engine.messages()->counters();
  return {{"broker", engine.site().mqtt_source->broker.address},
          {"connected", counters.connected},
          {"messages", counters.messages},
          {"unknown_valve", counters.unknown_valve},
          {"unknown", unknown_of(engine.messages()->unknown_senders(), "messages")}};
}

/// Of what goes out beside the page; each name once.
Json outputs_of(const Engine& engine) {
  Json out = Json::object();
  for (const OutputView& one : engine.outputs().views()) {
    out[one.name] = {{"sent", one.sent},       {"received", one.received},   {"dropped", one.dropped},
                     {"waiting", one.waiting}, {"connected", one.connected}, {"trouble", one.trouble}};
  }
  return out;
}

}  // namespace

std::string valves_json(const Engine& engine) {
  Json valves = Json::array();
  for (std::size_t k = 0; k < engine.size(); ++k) valves.push_back(valve_of(engine, k));
  return written(Json{{"valves", std::move(valves)}});
}

std::string valve_json(const Engine& engine, std::size_t valve) {
  return written(valve_of(engine, valve));
}

std::string events_json(const Engine& engine) {
  Json out = Json::array();
  std::vector<Event> events = engine.events();
  std::reverse(events.begin(), events.end());
  for (const Event& event : events) {
    out.push_back({{"id", event.id},
                   {"time", utc(event.wall_ms)},
                   {"valve", event.valve},
                   {"time_s", rounded(event.time_s, 6)},
                   {"kind", event.kind},
                   {"text", event.text}});
  }
  return written(Json{{"events", std::move(out)}});
}

std::string recordings_json(const Engine& engine) {
  Json out = Json::array();
  if (!engine.site().store.empty()) {
    for (const KeptRecording& one : list_recordings(engine.site().store, 1000)) {
      out.push_back({{"id", one.id}, {"time", utc(one.wall_ms)}, {"valve", one.valve}, {"why", one.why}});
    }
  }
  return written(Json{{"recordings", std::move(out)}});
}

std::string site_json(const Engine& engine) {
  double flow_m3_per_s = 0, power_W = 0;
  std::size_t stalled = 0, doubted = 0;
  std::array<std::size_t, 5> signs{};
  for (std::size_t k = 0; k < engine.size(); ++k) {
    const ValveView valve = engine.view(k);
    ++signs.at(static_cast<std::size_t>(valve.condition));
    doubted += sensor::has(valve.answer.status, sensor::Status::model_doubt) ? 1 : 0;
    if (engine.source(k).stalled) {
      ++stalled;
      continue;
    }
    const double flow = std::abs(valve.answer.flow_m3_per_s);
    const double power = flow * valve.answer.pressure_difference_Pa;
    if (std::isfinite(flow)) flow_m3_per_s += flow;
    if (std::isfinite(power)) power_W += power;
  }
  Json with_sign = Json::object();
  for (std::size_t k = 0; k < signs.size(); ++k)
    with_sign[std::string(monitor::name(static_cast<monitor::Ne107>(k)))] = signs[k];
  const UdpCounters udp = engine.udp_counters();
  const StoreView store = engine.store_view();
  return written(
      Json{{"valves", engine.size()},
           {"stalled", stalled},
           {"model_doubt", doubted},
           {"ne107", std::move(with_sign)},
           {"flow_L_min", rounded(flow_m3_per_s * litre_per_minute_per_m3_per_s, 3)},
           {"hydraulic_power_W", rounded(power_W, 1)},
           {"store", engine.site().store},
           {"store_trouble", store.trouble},
           {"store_mended",
            store.mended.empty() ? Json(nullptr) : Json{{"time", utc(store.mended_ms)}, {"text", store.mended}}},
           {"outputs", outputs_of(engine)},
           {"status_bits", status_bits()},
           {"udp",
            {{"port", engine.udp_port()},
             {"datagrams", udp.datagrams},
             {"unreadable", udp.unreadable},
             {"unknown_valve", udp.unknown_valve},
             {"not_allowed", udp.not_allowed},
             {"refused", udp.refused},
             {"unknown", unknown_of(engine.unknown_senders(), "datagrams")}}},
           {"mqtt_source", mqtt_source_of(engine)}});
}

}  // namespace spoolflow::live
