#include "addons/fleet/valve_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "addons/live/valve/event_text.hpp"

namespace spoolflow::fleet {
namespace {

/// Layout of a state that a site has: nothing is kept of sensor and monitor here.
constexpr std::string_view of_the_site = "of the site";
/// Beyond the ids that the fleet gives itself, should a site once have sent samples of the valve.
constexpr std::int64_t first_id_of_site = std::int64_t{1} << 40U;

/// One wait a line: "+" while the cause stands, "-" while it is away, since when, the cause.
std::string waits_text(const std::vector<live::AlarmWait>& waits) {
  std::string out;
  for (const live::AlarmWait& wait : waits)
    out += fmt::format("{}{} {}\n", wait.stands ? '+' : '-', wait.since_ms, wait.cause);
  return out;
}

std::vector<live::AlarmWait> waits_of(const std::string& text, const std::string& valve) {
  std::vector<live::AlarmWait> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t blank = line.find(' ');
    if (blank == std::string::npos) continue;
    out.push_back({valve, line.substr(blank + 1), std::strtoll(line.c_str() + 1, nullptr, 10), line[0] == '+'});
  }
  return out;
}

}  // namespace

ValveLine::ValveLine(std::string valve, std::string program, const live::AlarmDelays& delays)
    : valve_(std::move(valve)), program_(std::move(program)), delays_(delays), alarms_(delays) {
  position_.state.valve = valve_;
}

void ValveLine::restore(const KeptValve& kept, live::SharedModel model) {
  position_ = kept.position;
  if (position_.state.layout == of_the_site) {
    alarms_.restore(kept.alarms, {});
    return;
  }
  work_ = std::make_unique<live::ValveAtWork>(valve_, std::move(model), program_);
  if (!work_->restore(position_.state)) {
    // A program of another version: reported with the next block.
    rows_.events.push_back({.wall_ms = position_.wall_ms,
                            .valve = valve_,
                            .kind = "program",
                            .text = "sensor and monitor are reset: the program is another than before"});
  }
  reported_condition_ = work_->view(false).condition;
  alarms_.restore(kept.alarms, waits_of(position_.alarm_waits, valve_));
}

ValveLine::Turn ValveLine::turn(const Block& block) const {
  const BlockPlace& last = position_.block;
  if (block.session < last.session) return Turn::duplicate;
  if (block.session > last.session) return block.first == 1 ? Turn::next : Turn::early;
  if (block.number <= last.number) return Turn::duplicate;
  return block.first <= last.number + 1 ? Turn::next : Turn::early;
}

void ValveLine::add_event(std::string text, const Block& block) {
  rows_.events.push_back({.wall_ms = block.wall_ms, .valve = valve_, .kind = "program", .text = std::move(text)});
}

/// With the model that is in force from now on.
void ValveLine::begin(const live::SharedModel& model) {
  live::KeptState before{.valve = valve_};
  before.samples = position_.state.samples;
  before.energy_J = position_.state.energy_J;
  if (work_) before = work_->take_commit(false).state;
  work_ = std::make_unique<live::ValveAtWork>(valve_, model, program_);
  (void)work_->restore(before);  // counts go on, the rest is of another model
}

void ValveLine::work(const Block& block, const live::SharedModel& model) {
  live::ValveAtWork* const valve = begin_work(block, model);
  if (valve == nullptr) return;
  valve->work(samples(block));
  end_work(block);
}

live::SampleBlock ValveLine::samples(const Block& block) {
  constexpr std::int64_t ns_per_ms = 1'000'000;
  // Not zero, which means that nothing came.
  return {block.samples, {block.session, block.number + 1}, block.wall_ms * ns_per_ms + 1};
}

live::ValveAtWork* ValveLine::begin_work(const Block& block, const live::SharedModel& model) {
  const BlockPlace before = position_.block;
  const BlockPlace now{block.session, block.number};
  if (before.session != 0 && block.session != before.session) {
    add_event("the site's store is another: its blocks are counted from 1 again", block);
  }
  const std::uint64_t expected = block.session == before.session ? before.number + 1 : 1;
  if (block.number > expected) {
    add_event(fmt::format("blocks {} to {} are lost: the site could not keep them", expected, block.number - 1), block);
  }
  if (!block.set_aside.empty())
    add_event(fmt::format("block {} is set aside: it is {}", block.number, block.set_aside), block);
  if (!block.set_aside.empty() && !work_ && position_.state.layout == of_the_site) {
    position_.state.session = now.session;
    position_.state.next = now.number + 1;
    position_.block = now;
    position_.wall_ms = block.wall_ms;
    changed_ = true;
    return nullptr;
  }
  if (block.report) {
    if (model.sha256 != position_.model_sha256) rows_.models.push_back({now, model.sha256});
    position_.model_sha256 = model.sha256;
    position_.block = now;
    position_.wall_ms = block.wall_ms;
    take_report(*block.report);
    changed_ = true;
    return nullptr;
  }
  if (model.sha256 != position_.model_sha256 || !work_) {
    if (work_)
      add_event(fmt::format("the model {} is in force from block {} on; sensor and monitor are reset", model.sha256,
                            block.number),
                block);
    begin(model);
    if (model.sha256 != position_.model_sha256) rows_.models.push_back({now, model.sha256});
    position_.model_sha256 = model.sha256;
  }
  position_.block = now;
  position_.wall_ms = block.wall_ms;
  return work_.get();
}

void ValveLine::end_work(const Block& block) {
  if (!block.samples.empty()) look(block);
  changed_ = true;
}

/// As the site keeps it.
void ValveLine::take_report(const SiteReport& report) {
  const BlockPlace now = position_.block;
  work_.reset();
  position_.state = {.valve = valve_,
                     .session = now.session,
                     .next = now.number + 1,
                     .samples = report.samples,
                     .energy_J = report.energy_J,
                     .layout = std::string(of_the_site)};
  if (report.summary.samples > 0) rows_.seconds.push_back({now, position_.wall_ms, report.summary});
  for (const live::KeptIndicator& one : report.indicators) rows_.indicators.push_back({now, position_.wall_ms, one});
  for (live::Event one : report.events) {
    one.valve = valve_;
    rows_.events.push_back(std::move(one));
  }
  for (live::Alarm one : report.alarms) {
    one.valve = valve_;
    one.id += first_id_of_site;
    one.recording = 0;  // it stays at the site
    rows_.alarms.push_back(std::move(one));
  }
}

/// What the engine of a site does each second, here with each block.
void ValveLine::look(const Block& block) {
  const BlockPlace now = position_.block;
  rows_.seconds.push_back({now, block.wall_ms, work_->take_summary()});
  live::ValveView view = work_->view(false);
  constexpr double minute_s = 60;
  const std::int64_t minute =
      std::isfinite(view.time_s) ? static_cast<std::int64_t>(std::floor(view.time_s / minute_s)) : position_.minute;
  const bool keeps = minute != position_.minute;
  position_.minute = minute;
  if (keeps || view.condition != monitor::Ne107::good) view = work_->view();
  if (keeps) {
    for (const monitor::Indicator& one : view.indicators) {
      rows_.indicators.push_back({now,
                                  block.wall_ms,
                                  {std::string(one.name), one.value, one.uncertainty_95, one.baseline,
                                   std::string(monitor::name(one.state)), std::string(one.unit)}});
    }
  }
  for (const live::AlarmChange& change : alarms_.follow(view, live::troubles_of(view, false), block.wall_ms)) {
    rows_.events.push_back(live::alarm_event(view, change, block.wall_ms));
  }
  if (view.condition == reported_condition_) return;
  rows_.events.push_back(live::condition_event(view, reported_condition_, block.wall_ms));
  reported_condition_ = view.condition;
}

BlockPlace ValveLine::acknowledge(const Acknowledgement& seen) {
  const auto before = alarms_.all();
  const bool waits = std::any_of(before.begin(), before.end(), [&](const live::Alarm& alarm) {
    return alarm.id == seen.alarm && alarm.acknowledged_ms == 0;
  });
  if (waits) {
    const auto alarm = alarms_.acknowledge(seen.alarm, seen.by, seen.wall_ms);
    rows_.events.push_back({.wall_ms = seen.wall_ms,
                            .valve = valve_,
                            .kind = "alarm",
                            .text = fmt::format("alarm {} acknowledged by {}: {}", seen.alarm, seen.by, alarm->cause)});
    changed_ = true;
  }
  return position_.block;
}

std::optional<ValveRows> ValveLine::take_rows() {
  if (!changed_) return std::nullopt;
  changed_ = false;
  if (work_) position_.state = work_->take_commit(false).state;
  position_.alarm_waits = waits_text(alarms_.waits());
  rows_.position = position_;
  for (live::Alarm& one : alarms_.take_changed()) rows_.alarms.push_back(std::move(one));
  return std::exchange(rows_, {});
}

}  // namespace spoolflow::fleet
