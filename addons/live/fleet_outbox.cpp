#include "addons/live/fleet_outbox.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "addons/live/blocks/block.hpp"

namespace spoolflow::live {

FleetOutbox::FleetOutbox(const SiteSettings& site, const Valves& valves, Store& store, Journal& journal)
    : site_(site), valves_(valves), store_(store), journal_(journal), reported_(valves.size()) {
  store_.keep_on_disk();
  const double each_MB = memory_MB() / static_cast<double>(valves_.size());
  const BlockLimits limits{site_.fleet.block_s, static_cast<std::size_t>(1e6 * each_MB)};
  const std::uint64_t session = store_.session(wall_ms());
  const std::vector<OutboxPosition> before = store_.positions();
  for (std::size_t k = 0; k < valves_.size(); ++k) {
    OutboxPosition at{.valve = valves_[k]->id(), .session = session};
    const auto same =
        std::find_if(before.begin(), before.end(), [&](const auto& one) { return one.valve == at.valve; });
    if (same != before.end()) at = *same;
    if (site_.fleet.summaries_only) {
      reported_[k] = at;
    } else {
      valves_[k]->publish(fmt::format("{}/{}", site_.fleet.site, at.valve), at, limits);
    }
  }
}

double FleetOutbox::memory_MB() const {
  constexpr double most_MB = 256;
  return std::min(site_.fleet.largest_MB, most_MB);
}

void FleetOutbox::add_reports(std::int64_t now_ms, std::vector<ValveCommit>& commits, const std::vector<Event>& events,
                              const std::vector<Alarm>& alarms) const {
  for (std::size_t k = 0; k < commits.size(); ++k) {
    if (!reported_[k]) continue;
    ValveCommit& commit = commits[k];
    const std::string& id = valves_[k]->id();
    fleet::SiteReport report{commit.since_last, commit.state.samples, commit.state.energy_J, commit.indicators};
    for (const Event& one : events) {
      if (one.valve == id) report.events.push_back(one);
    }
    for (const Alarm& one : alarms) {
      if (one.valve == id) report.alarms.push_back(one);
    }
    if (report.summary.samples == 0 && report.indicators.empty() && report.events.empty() && report.alarms.empty()) {
      continue;
    }
    const OutboxPosition& at = *reported_[k];
    fleet::Block block{.valve = fmt::format("{}/{}", site_.fleet.site, id),
                       .model_sha256 = site_.valves[k].model.sha256,
                       .session = at.session,
                       .number = at.number + 1,
                       .first = at.number + 1,
                       .wall_ms = now_ms};
    block.report = std::move(report);
    commit.outbox_session = at.session;
    commit.blocks = {{block.number, fleet::write_block(block)}};
  }
}

void FleetOutbox::committed(const std::vector<ValveCommit>& commits) {
  for (std::size_t k = 0; k < commits.size(); ++k) {
    if (reported_[k]) reported_[k]->number += commits[k].blocks.size();
  }
}

void FleetOutbox::withdraw(std::size_t k, ValveCommit& commit) const {
  if (reported_[k]) commit.blocks.clear();
}

void FleetOutbox::given_up(std::uint64_t blocks, bool keeps) {
  if (blocks > 0 && given_up_ == 0) {
    journal_.note(fmt::format(
        "the store keeps nothing, and the blocks in memory that it should keep for the fleet are more than {:.3g} MB: "
        "the oldest are given up",
        memory_MB()));
  }
  given_up_ += blocks;
  if (!keeps || given_up_ == 0) return;
  journal_.note(fmt::format("{} blocks that the fleet had not got were given up while the store kept nothing",
                            std::exchange(given_up_, 0)));
}

void FleetOutbox::covered(const std::string& valve, std::uint64_t number) {
  const std::lock_guard lock(covered_mutex_);
  std::uint64_t& so_far = covered_[valve];
  so_far = std::max(so_far, number);
}

void FleetOutbox::forget_covered() {
  std::vector<OutboxPosition> gone;
  {
    const std::lock_guard lock(covered_mutex_);
    for (const auto& [valve, number] : std::exchange(covered_, {})) gone.push_back({.valve = valve, .covered = number});
  }
  if (!gone.empty()) store_.cover(gone);
}

}  // namespace spoolflow::live
