#include "addons/live/alarm_recording.hpp"

#include <utility>

#include <fmt/format.h>

namespace spoolflow::live {

void AlarmRecording::raised(const Alarm& alarm, const ValveView& valve) {
  alarms_.push_back(alarm.id);
  if (alarm_s_) return;
  alarm_s_ = valve.time_s;
  why_ = fmt::format("alarm {}: {}", alarm.id, alarm.cause);
}

void AlarmRecording::follow(const ValveAtWork& at_work, const ValveView& valve, bool nothing_comes, const Span& span,
                            Store& store, Journal& journal) {
  if (!alarm_s_) return;
  const double since_s = valve.time_s - *alarm_s_;
  if (since_s >= 0 && since_s < span.after_s && !nothing_comes) return;
  KeptRecording raw{.wall_ms = wall_ms(), .valve = valve.id, .why = why_};
  raw.csv = at_work.raw_csv(*alarm_s_ - span.before_s, *alarm_s_ + span.after_s);
  alarm_s_.reset();
  const std::vector<std::int64_t> alarms = std::exchange(alarms_, {});
  if (raw.csv.empty()) return;
  try {
    const std::int64_t id = store.keep_recording(raw);
    for (const std::int64_t alarm : alarms) journal.alarms.name_recording(alarm, id);
    journal.events.add({.wall_ms = wall_ms(),
                        .valve = valve.id,
                        .time_s = valve.time_s,
                        .kind = "recording",
                        .text = fmt::format("raw samples around {} are kept as recording {}", raw.why, id)});
  } catch (const StoreError&) {  // the next commit meets the same and reports it
  }
}

}  // namespace spoolflow::live
