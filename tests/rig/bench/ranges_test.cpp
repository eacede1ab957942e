/// Nothing inside the stated ranges makes the rig fail, and what lies outside is named.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/scenario.hpp"
#include "spoolflow/rig/bench/simulate.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::rig {
namespace {

/// Draws parameters from their own ranges: a quarter at either end, the rest between, by orders of magnitude where the
/// range spans them.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

  double in(const Parameter& range) {
    const double corner = uniform();
    if (corner < 0.125) return range.min;
    if (corner < 0.25) return range.max;
    const double share = uniform();
    if (range.min > 0 && range.max > 10 * range.min) return range.min * std::pow(range.max / range.min, share);
    return range.min + share * (range.max - range.min);
  }
  template <class Aggregate>
  void all(Aggregate& aggregate) {
    for_each_parameter(aggregate, [&](std::string_view, const Parameter& range, double& value) { value = in(range); });
  }

 private:
  std::mt19937_64 random_;
};

/// Every figure of the valve anywhere in its range; steps of the integrator below 10 us are left out for the time they
/// take.
ValveUnderTest any_valve(Draw& draw) {
  ValveUnderTest valve;
  draw.all(valve.plant);
  valve.plant.integration.longest_step_s = std::max(valve.plant.integration.longest_step_s, 2e-5);
  valve.plant.integration.shortest_step_s = std::max(valve.plant.integration.shortest_step_s, 1e-5);
  draw.all(valve.electronics);
  draw.all(valve.bench_amplifier);
  draw.all(valve.instruments);
  valve.plant.load.kind = static_cast<LoadKind>(draw.below(4));
  valve.plant.load.return_to_tank = draw.below(2) == 1;
  valve.electronics.dither.shape = static_cast<DitherShape>(draw.below(3));
  valve.plant.load.ideal_hold = draw.below(2) == 1;
  for (Solenoid* solenoid : {&valve.plant.solenoid_a, &valve.plant.solenoid_b}) {
    solenoid->hysteresis.kind = draw.below(2) == 1 ? HysteresisKind::preisach : HysteresisKind::jiles_atherton;
  }
  return valve;
}

BenchRun any_run(Draw& draw, const ValveUnderTest& valve) {
  const double temperature_C = 120 * draw.uniform() - 20;
  const OperationConditions conditions{.oil_temperature_start_C = temperature_C,
                                       .oil_temperature_end_C = 120 * draw.uniform() - 20,
                                       .supply_pressure_bar = 1 + 349 * draw.uniform(),
                                       .position_faults_per_s = 10 * draw.uniform()};
  const auto percent = [&] { return 200 * draw.uniform() - 100; };
  switch (draw.below(5)) {
    case 0:
      return plan(AxialForceProtocol{.oil_temperature_C = temperature_C}, valve, 1);
    case 1:
      return plan(SolenoidForceMapProtocol{.current_rate_percent_per_s = 200, .carriage_percent_per_s = 200}, valve, 1);
    case 2:
      return plan(StepsProtocol{.conditions = conditions,
                                .positions_percent = {percent(), percent(), percent(), 0},
                                .hold_s = 0.03,
                                .pressure_difference_bar = 350 * draw.uniform()},
                  valve, 1);
    case 3:
      return plan(PressureStepsProtocol{.conditions = conditions,
                                        .positions_percent = {percent()},
                                        .pressure_differences_bar = {350 * draw.uniform(), 350 * draw.uniform()},
                                        .hold_s = 0.05},
                  valve, 1);
    default:
      return plan(SineProtocol{.conditions = conditions,
                               .centre_percent = percent(),
                               .amplitude_percent = 30,
                               .frequency_start_Hz = 100,
                               .frequency_end_Hz = 500,
                               .sweep_s = 0.1},
                  valve, 1);
  }
}

/// The first part of a run, as long as that.
BenchRun first_part(BenchRun run, double duration_s) {
  run.sample_rate_Hz = {{std::min(duration_s, run.duration_s()), 1000}};
  return run;
}

class AnyValve : public testing::TestWithParam<int> {};

TEST_P(AnyValve, InsideItsRangesStaysFiniteAndInsideItsHousing) {
  Draw draw(static_cast<std::uint64_t>(GetParam()));
  const ValveUnderTest valve = any_valve(draw);
  ASSERT_NO_THROW(check_ranges(valve.plant));
  BenchRun run = first_part(any_run(draw, valve), 0.12);
  if (run.arrangement == Arrangement::valve) draw.all(run.machine);
  const Simulation simulation = simulate(valve, run, 1, {.with_truth = true});
  for (std::size_t k = 0; k < simulation.truth.columns.size(); ++k) {
    for (const double value : simulation.truth.columns[k]) {
      ASSERT_TRUE(std::isfinite(value)) << simulation.truth.quantities[k].header;
    }
  }
  for (const recording::Channel channel : run.channels) {
    for (const double value : simulation.recording[channel]) ASSERT_TRUE(std::isfinite(value)) << name(channel);
  }
  const double farthest_mm = 1e3 * std::max(valve.plant.spool.end_stop_m, 1.05 * valve.plant.spool.stroke_m) + 0.6;
  for (const double position_mm : simulation.truth["position_mm"]) ASSERT_LT(std::abs(position_mm), farthest_mm);
}

INSTANTIATE_TEST_SUITE_P(Ranges, AnyValve, testing::Range(1, 121));

TEST(AnyWear, LeavesEveryPresetInsideItsRanges) {
  for (const std::string& preset : valve_presets()) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      Draw draw(seed);
      ValveUnderTest valve = read_valve_and_campaign(preset).valve;
      valve.seed = seed;
      draw.all(valve.wear);
      draw.all(valve.spread);
      EXPECT_NO_THROW(static_cast<void>(as_built(valve))) << preset << ", seed " << seed;
    }
  }
}

TEST(AnyWear, OfWholeSeriesStillMovesAndFlows) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Draw draw(seed);
    ValveUnderTest valve;
    valve.seed = seed;
    valve.spread.amount = 1;
    valve.wear = {.edge_rounding_m = 4e-5 * draw.uniform(),
                  .friction_factor = 1 + draw.uniform(),
                  .spring_relaxation = 0.15 * draw.uniform(),
                  .shorted_turns_fraction = 0.1 * draw.uniform(),
                  .added_resistance_ohm = 0.5 * draw.uniform()};
    const StepsProtocol steps{.conditions = {}, .positions_percent = {80}, .hold_s = 0.8};
    const ValveUnderTest built = as_built(valve);
    const Simulation simulation = simulate(built, plan(steps, built, 1), seed, {.with_truth = true});
    EXPECT_NEAR(simulation.truth["position_mm"].back(), 0.8 * 2.4, 0.2) << "seed " << seed;
    EXPECT_GT(simulation.truth["flow_L_min"].back(), 30) << "seed " << seed;
  }
}

}  // namespace
}  // namespace spoolflow::rig
