#include "addons/live/valve_watch.hpp"

#include <fmt/format.h>

#include "addons/live/valve/event_text.hpp"

namespace spoolflow::live {

ValveWatch::ValveWatch(const SiteSettings& site, const Valves& valves, const ValveSources& sources, Journal& journal)
    : site_(site), valves_(valves), sources_(sources), journal_(journal), reported_(valves.size()) {}

void ValveWatch::resume(Store& store) {
  store_ = &store;
  for (std::size_t k = 0; k < valves_.size(); ++k) reported_[k].condition = valves_[k]->view(false).condition;
}

void ValveWatch::look() {
  for (std::size_t k = 0; k < valves_.size(); ++k) {
    Reported& before = reported_[k];
    const SourceView source = sources_.view(k);
    const ValveView valve = valves_[k]->view(false);
    look_at_source(valve, source, before);
    // Indicators take long: they are asked for where an alarm may keep them.
    follow_alarms(valve.condition == monitor::Ne107::good ? valve : valves_[k]->view(), source.stalled, before);
    if (store_ != nullptr) {
      before.recording.follow(*valves_[k], valve, source.stalled || sources_.finished(k),
                              {site_.raw_before_s, site_.raw_after_s}, *store_, journal_);
    }
    if (valve.condition == before.condition) continue;
    journal_.events.add(condition_event(valve, before.condition, wall_ms()));
    before.condition = valve.condition;
  }
}

void ValveWatch::look_at_source(const ValveView& valve, const SourceView& source, Reported& before) {
  const auto add = [&](std::string text) {
    journal_.events.add(
        {.wall_ms = wall_ms(), .valve = valve.id, .time_s = valve.time_s, .kind = "source", .text = std::move(text)});
  };
  if (source.stalled != before.stalled) {
    add(source.stalled ? fmt::format("no samples{}{}", source.trouble.empty() ? "" : ": ", source.trouble)
                       : "samples come in");
    before.stalled = source.stalled;
    if (source.stalled) before.trouble = source.trouble;
  }
  if (source.trouble != before.trouble && !source.trouble.empty()) add(source.trouble);
  before.trouble = source.trouble;
  if (source.unread != before.unread && !source.unread.empty()) add("the sender's samples: " + source.unread);
  before.unread = source.unread;
  if (before.findings.empty()) {  // their figures change from time to time
    for (const std::string& one : source.findings) add("the sender's samples: " + one);
  }
  before.findings = source.findings;
}

void ValveWatch::follow_alarms(const ValveView& valve, bool stalled, Reported& before) {
  for (const AlarmChange& change : journal_.alarms.follow(valve, troubles_of(valve, stalled), wall_ms())) {
    journal_.events.add(alarm_event(valve, change, wall_ms()));
    // Where nothing comes there is nothing to look at.
    const bool rises = change.kind == AlarmChange::Kind::raised || change.kind == AlarmChange::Kind::worse;
    if (!rises || change.alarm.cause == no_samples) continue;
    before.recording.raised(change.alarm, valve);
  }
}

}  // namespace spoolflow::live
