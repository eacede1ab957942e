/// What the engine keeps for the fleet until that has it.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/live/engine.hpp"

namespace spoolflow::live {

void Engine::begin_to_publish() {
  store_->keep_on_disk();
  const std::uint64_t session = store_->session(wall_ms());
  const std::vector<OutboxPosition> before = store_->positions();
  for (const auto& place : valves_) {
    OutboxPosition at{.valve = place->valve->id(), .session = session};
    const auto same =
        std::find_if(before.begin(), before.end(), [&](const auto& one) { return one.valve == at.valve; });
    if (same != before.end()) at = *same;
    place->valve->publish(fmt::format("{}/{}", site_.fleet.site, at.valve), at, site_.fleet.block_s);
  }
}

void Engine::covered(const std::string& valve, std::uint64_t number) {
  const std::lock_guard lock(covered_mutex_);
  std::uint64_t& so_far = covered_[valve];
  so_far = std::max(so_far, number);
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
