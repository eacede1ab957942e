#include "addons/live/valve/alarms.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::live {
namespace {

using monitor::Ne107;

bool is_cleared(const Alarm& alarm) {
  return alarm.gone_ms != 0 && alarm.acknowledged_ms != 0 && alarm.shelved_until_ms == 0;
}

/// With a true minus sign, as all texts have.
std::string figure(double value) {
  return fmt::format("{}{:.3g}", value < 0 ? "\u2212" : "", std::abs(value));
}

/// What was seen when the alarm was raised.
std::string seen(const ValveView& valve, const Trouble& trouble) {
  std::string out = fmt::format("NE 107 {}", monitor::name(trouble.sign));
  if (trouble.odds > 0) out += fmt::format(", odds {:.3g} to 1", trouble.odds);
  if (!std::isfinite(valve.time_s)) return out;
  constexpr double flow = units::litre_per_minute_per_m3_per_s;
  const sensor::Estimate<double>& answer = valve.answer;
  return out + fmt::format("; at {} L/min ({} to {}), {} bar", figure(answer.flow_m3_per_s * flow),
                           figure(answer.flow_lower_m3_per_s * flow), figure(answer.flow_upper_m3_per_s * flow),
                           figure(answer.pressure_difference_Pa / units::pascal_per_bar));
}

std::vector<KeptIndicator> judged_indicators(const ValveView& valve) {
  std::vector<KeptIndicator> out;
  for (const monitor::Indicator& one : valve.indicators) {
    if (one.state == monitor::IndicatorState::counts || !std::isfinite(one.value)) continue;
    out.push_back({std::string(one.name), one.value, one.uncertainty_95, one.baseline,
                   std::string(monitor::name(one.state)), std::string(one.unit)});
  }
  return out;
}

}  // namespace

Ne107 sign_named(std::string_view text) {
  for (const Ne107 sign : {Ne107::maintenance_required, Ne107::out_of_specification, Ne107::function_check}) {
    if (monitor::name(sign) == text) return sign;
  }
  return Ne107::failure;
}

std::string_view state_of(const Alarm& alarm) {
  if (alarm.shelved_until_ms != 0) return "shelved";
  if (alarm.gone_ms != 0) return alarm.acknowledged_ms != 0 ? "cleared" : "gone_unacknowledged";
  return alarm.acknowledged_ms != 0 ? "raised_acknowledged" : "raised_unacknowledged";
}

void Alarms::restore(std::vector<Alarm> alarms) {
  const std::lock_guard lock(mutex_);
  entries_.clear();
  for (Alarm& alarm : alarms) {
    next_id_ = std::max(next_id_, alarm.id + 1);
    entries_.push_back({std::move(alarm)});
  }
}

void Alarms::restore(std::vector<Alarm> alarms, const std::vector<AlarmWait>& waits) {
  restore(std::move(alarms));
  const std::lock_guard lock(mutex_);
  pending_.clear();
  for (const AlarmWait& wait : waits) {
    if (wait.stands) {
      pending_.push_back({wait.valve, wait.cause, wait.since_ms});
    } else if (Entry* entry = listed(wait.valve, wait.cause)) {
      entry->away_since_ms = wait.since_ms;
    }
  }
}

std::vector<AlarmWait> Alarms::waits() const {
  const std::lock_guard lock(mutex_);
  std::vector<AlarmWait> out;
  for (const Pending& one : pending_) out.push_back({one.valve, one.cause, one.since_ms, true});
  for (const Entry& one : entries_) {
    if (one.away_since_ms != 0 && one.alarm.gone_ms == 0) {
      out.push_back({one.alarm.valve, one.alarm.cause, one.away_since_ms, false});
    }
  }
  return out;
}

/// The one that is not cleared; there is one a valve and cause at most.
Alarms::Entry* Alarms::listed(const std::string& valve, const std::string& cause) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.alarm.valve == valve && entry.alarm.cause == cause && !is_cleared(entry.alarm);
  });
  return found == entries_.end() ? nullptr : &*found;
}

bool Alarms::has_stood(const std::string& valve, const std::string& cause, std::int64_t now_ms) {
  auto found = std::find_if(pending_.begin(), pending_.end(),
                            [&](const Pending& one) { return one.valve == valve && one.cause == cause; });
  if (found == pending_.end()) {
    pending_.push_back({valve, cause, now_ms});
    found = std::prev(pending_.end());
  }
  // A clock that was set back must not hold an alarm back.
  if (now_ms < found->since_ms) found->since_ms = now_ms;
  if (static_cast<double>(now_ms - found->since_ms) < 1e3 * delays_.raised_after_s) return false;
  pending_.erase(found);
  return true;
}

/// It is there, and was listed before.
void Alarms::stand(Entry& entry, const Trouble& trouble, std::int64_t now_ms, std::vector<AlarmChange>& changes) {
  entry.away_since_ms = 0;
  Alarm& alarm = entry.alarm;
  if (alarm.gone_ms != 0) {
    if (!has_stood(alarm.valve, alarm.cause, now_ms)) return;
    alarm.gone_ms = 0;
    ++alarm.times;
    changed_.insert(alarm.id);
    changes.push_back({AlarmChange::Kind::raised, alarm});
  }
  if (trouble.sign > sign_named(alarm.sign)) {
    // Who acknowledged less has not seen this.
    alarm.sign = monitor::name(trouble.sign);
    alarm.acknowledged_ms = 0;
    alarm.acknowledged_by.clear();
    changed_.insert(alarm.id);
    changes.push_back({AlarmChange::Kind::worse, alarm});
  }
}

std::vector<AlarmChange> Alarms::follow(const ValveView& valve, const std::vector<Trouble>& troubles,
                                        std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  std::vector<AlarmChange> changes;
  const auto is_there = [&](const std::string& cause) {
    return std::any_of(troubles.begin(), troubles.end(), [&](const Trouble& one) { return one.cause == cause; });
  };
  std::erase_if(pending_, [&](const Pending& one) { return one.valve == valve.id && !is_there(one.cause); });
  for (const Trouble& trouble : troubles) {
    if (Entry* entry = listed(valve.id, trouble.cause)) {
      stand(*entry, trouble, now_ms, changes);
    } else if (has_stood(valve.id, trouble.cause, now_ms)) {
      Alarm alarm;
      alarm.id = next_id_++;
      alarm.valve = valve.id;
      alarm.cause = trouble.cause;
      alarm.sign = monitor::name(trouble.sign);
      alarm.raised_ms = now_ms;
      alarm.time_s = valve.time_s;
      alarm.text = seen(valve, trouble);
      alarm.indicators = judged_indicators(valve);
      changed_.insert(alarm.id);
      changes.push_back({AlarmChange::Kind::raised, alarm});
      entries_.push_back({std::move(alarm)});
    }
  }
  for (Entry& entry : entries_) {
    Alarm& alarm = entry.alarm;
    if (alarm.valve != valve.id) continue;
    follow_shelf(alarm, now_ms, changes);
    if (alarm.gone_ms != 0 || is_there(alarm.cause)) continue;
    if (entry.away_since_ms == 0 || now_ms < entry.away_since_ms) entry.away_since_ms = now_ms;
    if (static_cast<double>(now_ms - entry.away_since_ms) < 1e3 * delays_.gone_after_s) continue;
    alarm.gone_ms = now_ms;
    changed_.insert(alarm.id);
    changes.push_back({AlarmChange::Kind::gone, alarm});
  }
  forget_the_oldest();
  return changes;
}

/// What is cleared and still to be kept stays.
void Alarms::forget_the_oldest() {
  auto cleared =
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& one) { return is_cleared(one.alarm); });
  std::erase_if(entries_, [&](const Entry& one) {
    if (cleared <= most_cleared || !is_cleared(one.alarm) || changed_.contains(one.alarm.id)) return false;
    --cleared;
    return true;
  });
}

Alarms::Entry* Alarms::numbered(std::int64_t id) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.alarm.id == id; });
  return found == entries_.end() ? nullptr : &*found;
}

std::optional<Alarm> Alarms::acknowledge(std::int64_t id, const std::string& by, std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = numbered(id);
  if (entry == nullptr) return std::nullopt;
  Alarm& alarm = entry->alarm;
  if (alarm.acknowledged_ms == 0) {
    alarm.acknowledged_ms = now_ms;
    alarm.acknowledged_by = by;
    changed_.insert(id);
  }
  return alarm;
}

std::optional<Alarm> Alarms::shelve(std::int64_t id, const std::string& by, std::int64_t until_ms,
                                    std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = numbered(id);
  if (entry == nullptr) return std::nullopt;
  if (!is_cleared(entry->alarm)) {
    entry->alarm.shelved_ms = now_ms;
    entry->alarm.shelved_until_ms = until_ms;
    entry->alarm.shelved_by = by;
    changed_.insert(id);
  }
  return entry->alarm;
}

/// Where it still stands, it is to be seen again.
void Alarms::take_off_the_shelf(Alarm& alarm) {
  alarm.shelved_ms = alarm.shelved_until_ms = 0;
  alarm.shelved_by.clear();
  if (alarm.gone_ms == 0) {
    alarm.acknowledged_ms = 0;
    alarm.acknowledged_by.clear();
  }
  changed_.insert(alarm.id);
}

std::optional<Alarm> Alarms::unshelve(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = numbered(id);
  if (entry == nullptr) return std::nullopt;
  if (entry->alarm.shelved_until_ms != 0) take_off_the_shelf(entry->alarm);
  return entry->alarm;
}

void Alarms::follow_shelf(Alarm& alarm, std::int64_t now_ms, std::vector<AlarmChange>& changes) {
  if (alarm.shelved_until_ms == 0) return;
  if (now_ms < alarm.shelved_ms) {  // a clock that was set back must not keep it there
    alarm.shelved_until_ms -= alarm.shelved_ms - now_ms;
    alarm.shelved_ms = now_ms;
    changed_.insert(alarm.id);
  }
  if (now_ms < alarm.shelved_until_ms) return;
  take_off_the_shelf(alarm);
  changes.push_back({AlarmChange::Kind::back, alarm});
}

std::optional<Alarm> Alarms::comment(std::int64_t id, const AlarmComment& comment) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = numbered(id);
  if (entry == nullptr) return std::nullopt;
  std::vector<AlarmComment>& all = entry->alarm.comments;
  if (all.size() == most_comments) all.erase(all.begin());
  all.push_back(comment);
  changed_.insert(id);
  return entry->alarm;
}

void Alarms::name_recording(std::int64_t id, std::int64_t recording) {
  const std::lock_guard lock(mutex_);
  for (Entry& entry : entries_) {
    if (entry.alarm.id != id) continue;
    entry.alarm.recording = recording;
    changed_.insert(id);
  }
}

std::vector<Alarm> Alarms::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<Alarm> out;
  out.reserve(entries_.size());
  for (const Entry& entry : entries_) out.push_back(entry.alarm);
  return out;
}

std::vector<Alarm> Alarms::take_changed() {
  const std::lock_guard lock(mutex_);
  std::vector<Alarm> out;
  for (const Entry& entry : entries_) {
    if (changed_.contains(entry.alarm.id)) out.push_back(entry.alarm);
  }
  changed_.clear();
  return out;
}

void Alarms::give_back(const std::vector<Alarm>& alarms) {
  const std::lock_guard lock(mutex_);
  for (const Alarm& alarm : alarms) changed_.insert(alarm.id);
}

}  // namespace spoolflow::live
