#include "addons/live/valve/event_text.hpp"

#include <cstdlib>

#include <fmt/format.h>

#include "addons/live/valve/utc_text.hpp"

namespace spoolflow::live {
namespace {

std::string duration(std::int64_t length_ms) {
  const double seconds = 1e-3 * static_cast<double>(length_ms);
  if (seconds < 120) return fmt::format("{:.1f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.1f} min", seconds / 60);
  return seconds < 172'800 ? fmt::format("{:.1f} h", seconds / 3600) : fmt::format("{:.1f} days", seconds / 86'400);
}

}  // namespace

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

std::string clock_text(std::int64_t wall_ms, std::int64_t step_ms) {
  return fmt::format(
      "the system clock was set {} by {}, to {}; no row is deleted or overwritten for it, and rows have the time of "
      "day that the clock shows",
      step_ms > 0 ? "forward" : "back", duration(std::abs(step_ms)), utc(wall_ms));
}

Event alarm_event(const ValveView& valve, const AlarmChange& change, std::int64_t wall_ms) {
  const char* const what = change.kind == AlarmChange::Kind::raised  ? "raised"
                           : change.kind == AlarmChange::Kind::worse ? "worse"
                           : change.kind == AlarmChange::Kind::back  ? "back from the shelf"
                                                                     : "gone";
  const Alarm& alarm = change.alarm;
  return {.wall_ms = wall_ms,
          .valve = valve.id,
          .time_s = valve.time_s,
          .kind = "alarm",
          .text = fmt::format("alarm {} {}: {}, NE 107 {}", alarm.id, what, alarm.cause, alarm.sign)};
}

}  // namespace spoolflow::live
