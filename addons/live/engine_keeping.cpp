/// What the engine of a site keeps each second, and how it reports store and clock.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "addons/live/engine.hpp"
#include "addons/live/valve/event_text.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {

/// What was known is put into a store that started again; what was deleted or damaged meanwhile is reported.
void Engine::look_after_store(std::int64_t now_ms) {
  if (const std::string done = store_->look_after(now_ms); !done.empty()) mended_ = done;
  if (mended_.empty()) return;
  store_->keep_again(events_.all(), alarms_.all());
  note(mended_);
  const std::lock_guard lock(trouble_mutex_);
  store_view_.mended = std::exchange(mended_, {});
  store_view_.mended_ms = now_ms;
  ++store_view_.mendings;
}

/// A step of the system's clock becomes an event. Before the start it is seen where it went back: forward it looks like
/// a program that was not running.
void Engine::follow_clock() {
  const Instant now = clock_();
  const std::int64_t step_ms =
      clock_before_ ? clock_step_ms(*clock_before_, now)
                    : std::min<std::int64_t>(0, clock_step_ms({.wall_ms = kept_before_ms_}, {.wall_ms = now.wall_ms}));
  clock_before_ = now;
  if (step_ms != 0) note(clock_text(now.wall_ms, step_ms));
}

/// Once those behind the alarm have come, too, or no more come.
void Engine::keep_raw_samples(Place& place, const ValveView& valve, bool nothing_comes) {
  if (!place.alarm_s || !store_) return;
  const double since_s = valve.time_s - *place.alarm_s;
  if (since_s >= 0 && since_s < site_.raw_after_s && !nothing_comes) return;
  KeptRecording raw{.wall_ms = wall_ms(), .valve = valve.id, .why = place.alarm};
  raw.csv = place.valve->raw_csv(*place.alarm_s - site_.raw_before_s, *place.alarm_s + site_.raw_after_s);
  place.alarm_s.reset();
  const std::vector<std::int64_t> alarms = std::exchange(place.alarms, {});
  if (raw.csv.empty()) return;
  try {
    const std::int64_t id = store_->keep_recording(raw);
    for (const std::int64_t alarm : alarms) alarms_.name_recording(alarm, id);
    events_.add({.wall_ms = wall_ms(),
                 .valve = valve.id,
                 .time_s = valve.time_s,
                 .kind = "recording",
                 .text = fmt::format("raw samples around {} are kept as recording {}", raw.why, id)});
  } catch (const StoreError&) {  // the next commit meets the same and reports it
  }
}

/// What is lost, and the sessions of senders, are counted up to the sample that was worked on last: what lies behind it
/// is met again after an end at any instant. Other counts are met once.
ValveCommit Engine::commit_of(std::size_t k, bool with_indicators) const {
  const Place& place = *valves_[k];
  ValveCommit out = place.valve->take_commit(with_indicators);
  const IntakeCounters all = place.before + place.intake->counters();
  out.state.counts.repeated = all.repeated;
  out.state.counts.unreadable = all.unreadable;
  const bool has_sessions = std::holds_alternative<UdpSettings>(site_.valves[k].source);
  if (!has_sessions) out.state.counts.connections = all.connections;
  return out;
}

void Engine::keep(bool with_indicators) {
  std::vector<ValveCommit> commits;
  commits.reserve(valves_.size());
  for (std::size_t k = 0; k < valves_.size(); ++k) commits.push_back(commit_of(k, with_indicators));
  const Instant now = clock_();
  const std::int64_t now_ms = now.wall_ms;
  std::string trouble;
  try {
    look_after_store(now_ms);
  } catch (const StoreError& error) {
    trouble = error.what();
  }
  std::vector<Event> events = events_.unkept();
  const std::vector<Alarm> alarms = alarms_.take_changed();
  report(now_ms, commits, events, alarms);
  std::uint64_t given_up = 0;
  try {
    if (!trouble.empty()) throw StoreError(trouble);
    store_->commit(now, commits, events, alarms);
    events_.kept(events);
    for (std::size_t k = 0; k < commits.size(); ++k) {
      if (valves_[k]->reported) valves_[k]->reported->number += commits[k].blocks.size();
    }
    forget_covered();
  } catch (const StoreError& error) {
    trouble = error.what();
    alarms_.give_back(alarms);
    for (std::size_t k = 0; k < commits.size(); ++k) {
      if (valves_[k]->reported) commits[k].blocks.clear();  // it is made again, with what comes until then
      given_up += valves_[k]->valve->give_back(commits[k]);
    }
  }
  tell_given_up(given_up, trouble.empty());
  const std::string before = store_view().trouble;
  if (!trouble.empty() && trouble != before) note(trouble);
  if (trouble.empty() && !before.empty()) note("the store keeps what comes again");
  const std::lock_guard lock(trouble_mutex_);
  store_view_.trouble = trouble;
}

void Engine::keep_each_second(const std::stop_token& stop) {
  constexpr int indicators_every = 60, retention_every = 60;
  parallel::SteadyTime next = std::chrono::steady_clock::now();
  for (int second = 1;; ++second) {
    next += std::chrono::seconds(1);
    if (!parallel::wait_until(next, stop)) return;
    follow_clock();
    watch_for_events();
    if (!store_) {
      (void)alarms_.take_changed();  // so that those of long ago can go
      continue;
    }
    keep(second % indicators_every == 1);
    if (second % retention_every != 1) continue;
    try {
      store_->retain(site_.retention);
      if (const std::int64_t lost = store_->drop_oldest_blocks(site_.fleet.largest_MB); lost > 0) {
        events_.add(
            {.wall_ms = wall_ms(),
             .kind = "program",
             .text = fmt::format("{} blocks that the fleet had not got were given up: they were more than {} MB", lost,
                                 site_.fleet.largest_MB)});
      }
    } catch (const StoreError&) {  // the next commit meets the same and reports it
    }
  }
}

}  // namespace spoolflow::live
