#include "spoolflow/rig/bench/campaign_items.hpp"

#include <string_view>

namespace spoolflow::rig {
namespace {

/// Each recording has its own noise, whatever else the campaign holds.
std::uint64_t seed_of(const ValveUnderTest& valve, std::string_view file) {
  Noise noise(valve.seed, std::string("recording ").append(file));
  return static_cast<std::uint64_t>(noise.uniform() * 0x1p52);
}

}  // namespace

std::vector<FedEdges> fed_edges(const CampaignSettings& settings, const std::string& direction) {
  if (!settings.one_edge_at_a_time) return {{"", LoadKind::held_path}};
  if (direction == "b") return {{"PB", LoadKind::held_difference}, {"AT", LoadKind::held_return}};
  return {{"PA", LoadKind::held_difference}, {"BT", LoadKind::held_return}};
}

CampaignItems::CampaignItems(const ValveUnderTest& valve) : valve_(as_built(valve)) {}

void CampaignItems::add(std::string file, std::string protocol, Protocol settings) {
  add_with(valve_, std::move(file), std::move(protocol), std::move(settings));
}

void CampaignItems::add_with(ValveUnderTest valve, std::string file, std::string protocol, Protocol settings) {
  const std::uint64_t seed = seed_of(valve_, file);
  items_.push_back({.file = std::move(file),
                    .protocol = std::move(protocol),
                    .settings = std::move(settings),
                    .valve = std::move(valve),
                    .seed = seed});
}

void CampaignItems::add_bench_test(std::string file, std::string protocol, Protocol settings, std::string direction,
                                   std::string edge) {
  add_with(direction == "a" ? turned_round(valve_) : valve_, std::move(file), std::move(protocol), std::move(settings));
  items_.back().direction = std::move(direction);
  items_.back().edge = std::move(edge);
}

}  // namespace spoolflow::rig
