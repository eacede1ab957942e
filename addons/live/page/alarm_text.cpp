#include "addons/live/page/alarm_text.hpp"

#include <algorithm>

#include "addons/live/page/alarm_words.hpp"
#include "addons/live/page/api_text.hpp"

namespace spoolflow::live {

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
  Json comments = Json::array();
  for (const AlarmComment& one : alarm.comments) {
    comments.push_back({{"time", utc(one.at_ms)}, {"by", one.by}, {"text", one.text}});
  }
  const AlarmWords* const words = words_for(alarm.cause, alarm.sign);
  const auto said = [&](std::string_view AlarmWords::*member) {
    return words == nullptr || (words->*member).empty() ? Json(nullptr) : Json(words->*member);
  };
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
          {"meaning", said(&AlarmWords::meaning)},
          {"remedy", said(&AlarmWords::remedy)},
          {"indicator", said(&AlarmWords::indicator)},
          {"shelved_until", utc_or_null(alarm.shelved_until_ms)},
          {"shelved_by", alarm.shelved_by.empty() ? Json(nullptr) : Json(alarm.shelved_by)},
          {"comments", std::move(comments)},
          {"recording", alarm.recording == 0 ? Json(nullptr) : Json(alarm.recording)},
          {"indicators", std::move(indicators)}};
}

std::string alarms_json(const Engine& engine) {
  Json out = Json::array();
  std::vector<Alarm> alarms = engine.alarms();
  std::reverse(alarms.begin(), alarms.end());
  for (const Alarm& alarm : alarms) out.push_back(json_of(alarm));
  return written(Json{{"alarms", std::move(out)}});
}

}  // namespace spoolflow::live
