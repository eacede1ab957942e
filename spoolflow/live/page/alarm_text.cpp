/// Alarms, sessions and figures over days as JSON.
#include <algorithm>

#include "spoolflow/live/page/api_text.hpp"
#include "spoolflow/live/page/json_text.hpp"

namespace spoolflow::live {
namespace {

Json json_of(const Alarm& alarm) {
  Json indicators = Json::array();
  for (const KeptIndicator& then : alarm.indicators) {
    indicators.push_back({{"name", then.name},
                          {"value", then.value},
                          {"unit", then.unit},
                          {"uncertainty_95", then.uncertainty_95},
                          {"baseline", then.baseline},
                          {"state", then.state}});
  }
  return {{"id", alarm.id},
          {"valve", alarm.valve},
          {"cause", alarm.cause},
          {"ne107", alarm.sign},
          {"state", state_of(alarm)},
          {"raised", utc(alarm.raised_ms)},
          {"times", alarm.times},
          {"gone", utc_or_null(alarm.gone_ms)},
          {"acknowledged", utc_or_null(alarm.acknowledged_ms)},
          {"acknowledged_by", alarm.acknowledged_by.empty() ? Json(nullptr) : Json(alarm.acknowledged_by)},
          {"time_s", rounded(alarm.time_s, 6)},
          {"text", alarm.text},
          {"recording", alarm.recording == 0 ? Json(nullptr) : Json(alarm.recording)},
          {"indicators", std::move(indicators)}};
}

}  // namespace

std::string alarm_json(const Alarm& alarm) {
  return written(json_of(alarm));
}

std::string alarms_json(const Engine& engine) {
  Json out = Json::array();
  std::vector<Alarm> alarms = engine.alarms();
  std::reverse(alarms.begin(), alarms.end());
  for (const Alarm& alarm : alarms) out.push_back(json_of(alarm));
  return written(Json{{"alarms", std::move(out)}});
}

std::string session_json(const Visitor& visitor, bool has_accounts) {
  return written(Json{{"account", visitor.role == Role::none || !has_accounts ? Json(nullptr) : Json(visitor.name)},
                      {"role", name(visitor.role)},
                      {"accounts", has_accounts}});
}

std::optional<LoginAsked> login_of(const std::string& body) {
  const Json asked = Json::parse(body, nullptr, false);
  if (!asked.is_object() || !asked.contains("name") || !asked.contains("password")) return std::nullopt;
  if (!asked["name"].is_string() || !asked["password"].is_string()) return std::nullopt;
  return LoginAsked{asked["name"].get<std::string>(), asked["password"].get<std::string>()};
}

}  // namespace spoolflow::live
