#include "addons/live/site_keeper.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace spoolflow::live {

SiteKeeper::SiteKeeper(const SiteSettings& site, const Valves& valves, ValveSources& sources, Journal& journal)
    : site_(site),
      valves_(valves),
      sources_(sources),
      journal_(journal),
      store_(site.store),
      kept_before_ms_(store_.newest().wall_ms) {
  restore();
  if (!site_.fleet.servers.empty()) outbox_.emplace(site_, valves_, store_, journal_);
}

void SiteKeeper::restore() {
  journal_.events.restore(store_.events(static_cast<int>(Events::most)));
  journal_.alarms.restore(store_.alarms(Alarms::most_cleared));
  journal_.reported.restore(store_.reported());
  for (const KeptState& kept : store_.states()) {
    const auto same =
        std::find_if(valves_.begin(), valves_.end(), [&](const auto& valve) { return valve->id() == kept.valve; });
    if (same == valves_.end()) continue;
    sources_.resume(static_cast<std::size_t>(same - valves_.begin()), {kept.session, kept.next},
                    {kept.samples + kept.counts.dropped, kept.counts.dropped, kept.counts.lost, kept.counts.repeated,
                     kept.counts.unreadable, kept.counts.connections});
    if ((*same)->restore(kept)) continue;
    journal_.events.add({.wall_ms = wall_ms(),
                         .valve = kept.valve,
                         .kind = "program",
                         .text = "sensor and monitor are reset: the model or the program is another than before, or "
                                 "what was kept is damaged"});
  }
}

StoreView SiteKeeper::view() const {
  const std::lock_guard lock(view_mutex_);
  return view_;
}

/// What was known is put into a store that started again; what was deleted or damaged meanwhile is reported.
void SiteKeeper::look_after_store(std::int64_t now_ms) {
  if (const std::string done = store_.look_after(now_ms); !done.empty()) mended_ = done;
  if (mended_.empty()) return;
  store_.keep_again(journal_.events.all(), journal_.alarms.all(), journal_.reported.all());
  journal_.note(mended_);
  const std::lock_guard lock(view_mutex_);
  view_.mended = std::exchange(mended_, {});
  view_.mended_ms = now_ms;
  ++view_.mendings;
}

/// What is lost, and the sessions of senders, are counted up to the sample that was worked on last: what lies behind it
/// is met again after an end at any instant. Other counts are met once.
ValveCommit SiteKeeper::commit_of(std::size_t k, bool with_indicators) const {
  ValveCommit out = valves_[k]->take_commit(with_indicators);
  const IntakeCounters all = sources_.view(k).counters;
  out.state.counts.repeated = all.repeated;
  out.state.counts.unreadable = all.unreadable;
  if (!sources_.has_sessions(k)) out.state.counts.connections = all.connections;
  return out;
}

std::vector<ValveCommit> SiteKeeper::commits(bool with_indicators) const {
  std::vector<ValveCommit> out;
  out.reserve(valves_.size());
  for (std::size_t k = 0; k < valves_.size(); ++k) out.push_back(commit_of(k, with_indicators));
  return out;
}

std::string SiteKeeper::commit(const Instant& now, std::vector<ValveCommit>& commits) {
  std::string trouble;
  try {
    look_after_store(now.wall_ms);
  } catch (const StoreError& error) {
    trouble = error.what();
  }
  std::vector<Event> events = journal_.events.unkept();
  // Before the alarms: nobody has a message of one that is not kept with it.
  ReportedTexts reported = journal_.reported.take_changed();
  const std::vector<Alarm> alarms = journal_.alarms.take_changed();
  if (outbox_) outbox_->add_reports(now.wall_ms, commits, events, alarms);
  if (trouble.empty()) {
    try {
      store_.commit(now, commits, events, alarms, reported);
      journal_.events.kept(events);
      return {};
    } catch (const StoreError& error) {
      trouble = error.what();
    }
  }
  journal_.alarms.give_back(alarms);
  journal_.reported.give_back(std::move(reported));
  return trouble;
}

void SiteKeeper::keep(const Instant& now, bool with_indicators) {
  std::vector<ValveCommit> all = commits(with_indicators);
  const std::string trouble = commit(now, all);
  std::uint64_t given_up = 0;
  for (std::size_t k = 0; k < all.size() && !trouble.empty(); ++k) {
    if (outbox_) outbox_->withdraw(k, all[k]);
    given_up += valves_[k]->give_back(all[k]);
  }
  if (outbox_) {
    if (trouble.empty()) outbox_->committed(all);
    outbox_->given_up(given_up, trouble.empty());
  }
  report(trouble, now.wall_ms);
  if (!outbox_ || !trouble.empty()) return;
  try {
    outbox_->forget_covered();
  } catch (const StoreError&) {  // the next commit meets the same and reports it
  }
}

/// A fault of the store, once at its beginning and once at its end.
void SiteKeeper::report(const std::string& trouble, std::int64_t now_ms) {
  const std::string before = view().trouble;
  if (!trouble.empty() && trouble != before) journal_.note(trouble);
  if (trouble.empty() && !before.empty()) {
    journal_.note("the store works again; what came while it failed is in it, the flow as one row");
  }
  const std::lock_guard lock(view_mutex_);
  view_.trouble = trouble;
  if (trouble.empty()) view_.kept_ms = now_ms;
}

void SiteKeeper::retain() {
  try {
    store_.retain(site_.retention);
    const std::int64_t lost = store_.drop_oldest_blocks(site_.fleet.largest_MB);
    if (lost == 0) return;
    journal_.events.add(
        {.wall_ms = wall_ms(),
         .kind = "program",
         .text = fmt::format("{} blocks that the fleet had not got were given up: they were more than {} MB", lost,
                             site_.fleet.largest_MB)});
  } catch (const StoreError&) {  // the next commit meets the same and reports it
  }
}

}  // namespace spoolflow::live
