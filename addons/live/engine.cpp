#include "addons/live/engine.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "addons/live/valve/event_text.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {
namespace {

Valves valves_of(const SiteSettings& site, const std::string& program) {
  // Alarms are looked at each second: the oldest samples must last until then.
  const double raw_s = site.store.empty() ? 0 : site.raw_before_s + site.raw_after_s + 2;
  Valves out;
  for (const ValveSettings& one : site.valves)
    out.push_back(std::make_unique<ValveAtWork>(one.id, one.model, program, raw_s));
  return out;
}

}  // namespace

Engine::Engine(SiteSettings site, const std::string& program)
    : site_(std::move(site)),
      valves_(valves_of(site_, program)),
      journal_(site_.alarms),
      sources_(site_, valves_),
      watch_(site_, valves_, sources_, journal_) {
  if (site_.store.empty()) return;
  keeper_.emplace(site_, valves_, sources_, journal_);
  watch_.resume(keeper_->store());
}

Engine::~Engine() {
  try {
    stop();
  } catch (const std::exception&) {  // the store keeps what it has
  }
}

void Engine::start() {
  sources_.start();
  beat_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
}

void Engine::stop() {
  const bool worked = beat_.joinable();
  beat_ = {};  // it looks at the sources
  sources_.stop();
  if (worked && keeper_) keeper_->keep(clock_(), true);
}

void Engine::beat(const std::stop_token& stop) {
  constexpr int indicators_every = 60, retention_every = 60;
  parallel::SteadyTime next = std::chrono::steady_clock::now();
  for (int second = 1;; ++second) {
    next += std::chrono::seconds(1);
    if (!parallel::wait_until(next, stop)) return;
    follow_clock();
    sources_.finish_ended();
    watch_.look();
    if (!keeper_) {
      (void)journal_.alarms.take_changed();  // so that those of long ago can go
      continue;
    }
    keeper_->keep(clock_(), second % indicators_every == 1);
    if (second % retention_every == 1) keeper_->retain();
  }
}

/// A step of the system's clock becomes an event. Before the start it is seen where it went back: forward it looks like
/// a program that was not running.
void Engine::follow_clock() {
  const Instant now = clock_();
  const std::int64_t kept_ms = keeper_ ? keeper_->kept_before_ms() : 0;
  const std::int64_t step_ms =
      clock_before_ ? clock_step_ms(*clock_before_, now)
                    : std::min<std::int64_t>(0, clock_step_ms({.wall_ms = kept_ms}, {.wall_ms = now.wall_ms}));
  clock_before_ = now;
  if (step_ms != 0) note(clock_text(now.wall_ms, step_ms));
}

ValveView Engine::view(std::size_t k) const {
  ValveView out = valves_[k]->view();
  if (source(k).stalled) out.condition = std::max(out.condition, monitor::Ne107::function_check);
  return out;
}

/// What somebody did with it.
void Engine::report_alarm(const std::optional<Alarm>& alarm, const std::string& what) {
  if (!alarm) return;
  journal_.events.add({.wall_ms = wall_ms(),
                       .valve = alarm->valve,
                       .kind = "alarm",
                       .text = fmt::format("alarm {} {}: {}", alarm->id, what, alarm->cause)});
}

std::optional<Alarm> Engine::acknowledge(std::int64_t alarm, const std::string& by) {
  std::optional<Alarm> found = journal_.alarms.acknowledge(alarm, by, wall_ms());
  report_alarm(found, "acknowledged by " + by);
  return found;
}

std::optional<Alarm> Engine::shelve(std::int64_t alarm, const std::string& by, double hours) {
  const std::int64_t now_ms = wall_ms(), until_ms = now_ms + static_cast<std::int64_t>(3.6e6 * hours);
  std::optional<Alarm> found = journal_.alarms.shelve(alarm, by, until_ms, now_ms);
  if (found && found->shelved_until_ms != 0) report_alarm(found, fmt::format("shelved for {:.3g} h by {}", hours, by));
  return found;
}

std::optional<Alarm> Engine::unshelve(std::int64_t alarm, const std::string& by) {
  std::optional<Alarm> found = journal_.alarms.unshelve(alarm);
  report_alarm(found, "taken off the shelf by " + by);
  return found;
}

std::optional<Alarm> Engine::comment(std::int64_t alarm, const std::string& by, const std::string& text) {
  std::optional<Alarm> found = journal_.alarms.comment(alarm, {.at_ms = wall_ms(), .by = by, .text = text});
  report_alarm(found, fmt::format("commented by {} (\"{}\")", by, text));
  return found;
}

void Engine::covered(const std::string& valve, std::uint64_t number) {
  if (keeper_ && keeper_->outbox() != nullptr) keeper_->outbox()->covered(valve, number);
}

}  // namespace spoolflow::live
