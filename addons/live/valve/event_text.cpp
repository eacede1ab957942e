#include "addons/live/valve/event_text.hpp"

#include <fmt/format.h>

namespace spoolflow::live {

Event condition_event(const ValveView& valve, monitor::Ne107 before, std::int64_t wall_ms) {
  std::string causes;
  for (const monitor::Cause& cause : valve.causes) {
    causes += fmt::format("{}{} (odds {:.3g})", causes.empty() ? ": " : ", ", monitor::name(cause.fault), cause.odds);
  }
  return {.wall_ms = wall_ms,
          .valve = valve.id,
          .time_s = valve.time_s,
          .kind = "condition",
          .text = fmt::format("NE 107 {} after {}{}", monitor::name(valve.condition), monitor::name(before), causes)};
}

Event alarm_event(const ValveView& valve, const AlarmChange& change, std::int64_t wall_ms) {
  const char* const what = change.kind == AlarmChange::Kind::raised  ? "raised"
                           : change.kind == AlarmChange::Kind::worse ? "worse"
                                                                     : "gone";
  const Alarm& alarm = change.alarm;
  return {.wall_ms = wall_ms,
          .valve = valve.id,
          .time_s = valve.time_s,
          .kind = "alarm",
          .text = fmt::format("alarm {} {}: {}, NE 107 {}", alarm.id, what, alarm.cause, alarm.sign)};
}

}  // namespace spoolflow::live
