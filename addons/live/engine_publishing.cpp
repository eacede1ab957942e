/// What the engine keeps for the fleet until that has it.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "addons/live/blocks/block.hpp"
#include "addons/live/engine.hpp"

namespace spoolflow::live {
namespace {

/// Of all valves.
constexpr double most_waiting_in_memory_MB = 256;

}  // namespace

void Engine::begin_to_publish() {
  store_->keep_on_disk();
  const double each_MB =
      std::min(site_.fleet.largest_MB, most_waiting_in_memory_MB) / static_cast<double>(valves_.size());
  const BlockLimits limits{site_.fleet.block_s, static_cast<std::size_t>(1e6 * each_MB)};
  const std::uint64_t session = store_->session(wall_ms());
  const std::vector<OutboxPosition> before = store_->positions();
  for (const auto& place : valves_) {
    OutboxPosition at{.valve = place->valve->id(), .session = session};
    const auto same =
        std::find_if(before.begin(), before.end(), [&](const auto& one) { return one.valve == at.valve; });
    if (same != before.end()) at = *same;
    if (site_.fleet.summaries_only) {
      place->reported = at;
      continue;
    }
    place->valve->publish(fmt::format("{}/{}", site_.fleet.site, at.valve), at, limits);
  }
}

/// Adds to each commit what the fleet gets of it, where it gets no samples: in the same transaction.
void Engine::report(std::int64_t now_ms, std::vector<ValveCommit>& commits, const std::vector<Event>& events,
                    const std::vector<Alarm>& alarms) const {
  for (std::size_t k = 0; k < commits.size(); ++k) {
    const Place& place = *valves_[k];
    if (!place.reported) continue;
    ValveCommit& commit = commits[k];
    const std::string& id = place.valve->id();
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
    const OutboxPosition& at = *place.reported;
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

void Engine::covered(const std::string& valve, std::uint64_t number) {
  const std::lock_guard lock(covered_mutex_);
  std::uint64_t& so_far = covered_[valve];
  so_far = std::max(so_far, number);
}

/// A site whose disk is full for hours reports it once, and all that it cost when the store keeps again.
void Engine::tell_given_up(std::uint64_t blocks, bool keeps) {
  if (blocks > 0 && blocks_given_up_ == 0) {
    note(fmt::format(
        "the store keeps nothing, and the blocks in memory that it should keep for the fleet are more than {:.3g} MB: "
        "the oldest are given up",
        std::min(site_.fleet.largest_MB, most_waiting_in_memory_MB)));
  }
  blocks_given_up_ += blocks;
  if (!keeps || blocks_given_up_ == 0) return;
  note(fmt::format("{} blocks that the fleet had not got were given up while the store kept nothing",
                   std::exchange(blocks_given_up_, 0)));
}

void Engine::forget_covered() {
  std::vector<OutboxPosition> gone;
  {
    const std::lock_guard lock(covered_mutex_);
    for (const auto& [valve, number] : std::exchange(covered_, {})) gone.push_back({.valve = valve, .covered = number});
  }
  if (!gone.empty()) store_->cover(gone);
}

}  // namespace spoolflow::live
