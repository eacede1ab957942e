#include "spoolflow/rig/bench/flow_bench_campaign.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace spoolflow::rig {
namespace {

/// Short random moves and rests at some pressure differences: they show eddy currents, moving mass and how friction
/// grows at rest.
DutyCycleProtocol random_moves(const CampaignSettings& settings) {
  const double highest_bar =
      *std::max_element(settings.pressure_differences_bar.begin(), settings.pressure_differences_bar.end());
  return {.conditions = {},
          .duration_s = 90,
          .slowest_percent_per_s = 50,
          .fastest_percent_per_s = 2000,
          .longest_hold_s = 2,
          .lowest_pressure_bar = 0.5 * highest_bar,
          .highest_pressure_bar = 0.9 * highest_bar,
          .longest_pressure_hold_s = 30};
}

FlowBenchProtocol metering(const CampaignSettings& settings, double temperature_C) {
  return {.pressure_differences_bar = settings.pressure_differences_bar, .oil_temperature_C = temperature_C};
}

void add_direction(CampaignItems& items, const CampaignSettings& settings, const std::string& direction) {
  items.add_bench_test("unpressurised_" + direction + ".csv", "unpressurised_strokes", unpressurised_protocol(),
                       direction);
  for (const FedEdges& fed : fed_edges(settings, direction)) {
    for (const double temperature_C : settings.oil_temperatures_C) {
      FlowBenchProtocol protocol = metering(settings, temperature_C);
      protocol.load = fed.load;
      items.add_bench_test(fmt::format("metering_{:g}_{}.csv", temperature_C, fed.edge.empty() ? direction : fed.edge),
                           "metering", protocol, direction, fed.edge);
    }
  }
}

}  // namespace

void add_flow_bench(CampaignItems& items, const CampaignSettings& settings) {
  DutyCycleProtocol moves = random_moves(settings);
  if (items.valve().whole) {
    for (const char* direction : {"b", "a"}) add_direction(items, settings, direction);
    moves.conditions.supply_follows_difference = true;
    moves.lowest_percent = -100;
    items.add("both_random_moves.csv", "operation", moves);
    return;
  }
  items.add("unpressurised.csv", "unpressurised_strokes", unpressurised_protocol());
  for (const double temperature_C : settings.oil_temperatures_C)
    items.add(fmt::format("metering_{:g}.csv", temperature_C), "metering", metering(settings, temperature_C));
  items.add("random_moves.csv", "operation", moves);
}

}  // namespace spoolflow::rig
