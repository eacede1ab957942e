/// Whole simulated recordings: what every protocol gives, and that it repeats.
#include "spoolflow/rig/bench/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"

namespace spoolflow::rig {
namespace {

using recording::Channel;

BenchRun beginning(BenchRun run, double duration_s) {
  std::vector<Span<double>> rates;
  for (const Span<double>& span : run.sample_rate_Hz) {
    rates.push_back({std::min(span.until_s, duration_s), span.value});
    if (span.until_s >= duration_s) break;
  }
  run.sample_rate_Hz = rates;
  return run;
}

std::string bytes_of(std::uint64_t seed) {
  ValveUnderTest valve;
  valve.spread.amount = 1;
  valve.seed = seed;
  valve = as_built(valve);
  BenchRun run = beginning(plan(protocol_named("duty_cycle"), valve, seed), 1.5);
  run.position_faults_per_s = 5;
  const Simulation simulation = simulate(valve, run, seed, {.with_truth = true});
  std::ostringstream text;
  write_recording(text, simulation.recording, run);
  write_truth(text, simulation.truth);
  return text.str();
}

TEST(Simulate, SameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  const std::string first = bytes_of(7);
  EXPECT_EQ(bytes_of(7), first);
  EXPECT_NE(bytes_of(8), first);
}

TEST(Simulate, ValvesTogetherGiveTheBytesThatEachGivesAlone) {
  std::vector<ValveUnderTest> valves;
  std::vector<BenchRun> runs;
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ValveUnderTest valve;
    valve.spread.amount = 1;
    valve.seed = seed;
    valves.push_back(as_built(valve));
    const char* const protocol = seed == 4 ? "steps" : "duty_cycle";
    runs.push_back(beginning(plan(protocol_named(protocol), valves.back(), seed), seed == 2 ? 0.8 : 1.2));
    runs.back().position_faults_per_s = 5;
    seeds.push_back(seed);
  }
  const auto text_of = [](const Simulation& simulation, const BenchRun& run) {
    std::ostringstream text;
    write_recording(text, simulation.recording, run);
    write_truth(text, simulation.truth);
    return text.str();
  };
  const std::vector<Simulation> together = simulate_together(valves, runs, seeds, {.with_truth = true});
  ASSERT_EQ(together.size(), valves.size());
  for (std::size_t k = 0; k < valves.size(); ++k) {
    EXPECT_EQ(text_of(together[k], runs[k]),
              text_of(simulate(valves[k], runs[k], seeds[k], {.with_truth = true}), runs[k]))
        << "valve " << k;
  }
}

class EveryProtocol : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryProtocol, FillsItsChannelsAndItsTruthAtTheSameTimes) {
  const NamedProtocol& protocol = protocols()[GetParam()];
  const ValveUnderTest valve;
  const BenchRun run = beginning(plan(protocol.settings, valve, 1), 1.2);
  const Simulation simulation = simulate(valve, run, 1, {.with_truth = true});
  const std::span<const double> time = simulation.recording[Channel::time];
  ASSERT_GT(time.size(), 100U);
  for (const Channel channel : run.channels) EXPECT_EQ(simulation.recording[channel].size(), time.size());
  ASSERT_EQ(simulation.truth.size(), time.size());
  EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_NEAR(simulation.truth["time_s"][i], time[i], 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Protocols, EveryProtocol, testing::Range<std::size_t>(0, 11),
                         [](const auto& which) { return std::string(protocols()[which.param].name); });

TEST(Simulate, NegativeSetPositionsPullWithTheOtherSolenoidAndOpenTheOtherEdge) {
  const ValveUnderTest valve;
  const auto end_of = [&](double percent) {
    const StepsProtocol steps{.conditions = {}, .positions_percent = {percent}, .hold_s = 0.6};
    const Simulation simulation = simulate(valve, plan(steps), 1, {.with_truth = true});
    return std::array{simulation.recording[Channel::position].back(), simulation.recording[Channel::current].back(),
                      simulation.truth["flow_L_min"].back()};
  };
  const auto [b_m, b_A, b_flow] = end_of(60);
  const auto [a_m, a_A, a_flow] = end_of(-60);
  EXPECT_NEAR(b_m, 0.6 * 2.4e-3, 0.15e-3);
  EXPECT_NEAR(a_m, -0.6 * 2.4e-3, 0.15e-3);
  EXPECT_GT(b_A, 0.5);
  EXPECT_LT(a_A, -0.5);
  EXPECT_NEAR(a_flow / b_flow, 1, 0.15);  // through P to A
}

TEST(Simulate, FastMotionIsRecordedAtTenKilohertz) {
  const ValveUnderTest valve;
  const BenchRun run = beginning(plan(protocol_named("fast_motion"), valve, 1), 0.5);
  EXPECT_EQ(simulate(valve, run, 1).recording.size(), 5000U);
}

TEST(Simulate, PressureStepsMoveTheFlowWhileTheSetPositionRests) {
  const ValveUnderTest valve;
  PressureStepsProtocol protocol{.conditions = {}, .positions_percent = {60}, .pressure_differences_bar = {20, 60}};
  protocol.hold_s = 0.5;
  const BenchRun run = plan(protocol);
  const Simulation simulation = simulate(valve, run, 1, {.with_truth = true});
  const auto& time = simulation.truth["time_s"];
  const auto at = [&](double wanted_s) {
    return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), wanted_s) - time.begin());
  };
  const double step_s = run.duration_s() - (0.5 + 0.6 / 0.5) - 0.5;  // closing ramp and rest follow the second level
  const std::size_t before = at(step_s - 0.05), after = at(step_s + 0.4);
  EXPECT_EQ(simulation.recording[Channel::position_set][before], simulation.recording[Channel::position_set][after]);
  EXPECT_NEAR(simulation.truth["pressure_difference_bar"][before], 20, 2);
  EXPECT_NEAR(simulation.truth["pressure_difference_bar"][after], 60, 2);
  EXPECT_GT(simulation.truth["flow_L_min"][after], 1.3 * simulation.truth["flow_L_min"][before]);
}

TEST(Simulate, TemperatureSweepWarmsTheOilAndDriftsThePositionSensor) {
  const ValveUnderTest valve;
  RampsProtocol sweep = std::get<RampsProtocol>(protocol_named("temperature_sweep"));
  sweep.pressure_differences_bar = {50};
  sweep.rate_percent_per_s = 200;
  sweep.hold_s = 0.2;
  const Simulation simulation = simulate(valve, plan(sweep), 1, {.with_truth = true});
  const std::span<const double> oil_K = simulation.recording[Channel::oil_temperature];
  EXPECT_NEAR(oil_K.front(), 303.15, 1.5);
  EXPECT_GT(oil_K.back(), oil_K.front() + 15);  // the thermometer lags this short run
  const auto sensor_error_m = [&](std::size_t i) {
    return simulation.recording[Channel::position][i] - 1e-3 * simulation.truth["position_mm"][i];
  };
  const double drift_m = sensor_error_m(oil_K.size() - 1) - sensor_error_m(0);
  EXPECT_NEAR(drift_m, valve.instruments.lvdt.zero_drift_per_K * 2.4e-3 * 45, 4e-6);
}

TEST(Simulate, TheElectronicsAddTheRequestedDitherAtEachSample) {
  const ValveUnderTest valve;
  const StepsProtocol steps{.conditions = {}, .positions_percent = {60}, .hold_s = 1.2};
  const BenchRun run = plan(steps);
  std::vector<double> told_A;
  const auto in_the_middle = [&](const MeasuredSample& measured) {
    told_A.push_back(measured.current_A);
    EXPECT_FALSE(std::isnan(measured.voltage_V + measured.position_m + measured.oil_temperature_K));
    return Dither{.amplitude_A = measured.time_s > 0.8 && measured.time_s < 1.1 ? 0.2 : 0.0, .frequency_Hz = 125};
  };
  const Simulation simulation = simulate(valve, run, 1, {.dither = in_the_middle});
  const std::span<const double> current_A = simulation.recording[Channel::current];
  EXPECT_TRUE(std::equal(told_A.begin(), told_A.end(), current_A.begin(), current_A.end()));
  const auto ripple_A = [&](std::size_t from, std::size_t to) {
    const auto [least, most] = std::minmax_element(current_A.begin() + static_cast<std::ptrdiff_t>(from),
                                                   current_A.begin() + static_cast<std::ptrdiff_t>(to));
    return *most - *least;
  };
  EXPECT_LT(ripple_A(700, 800), 0.1);
  EXPECT_GT(ripple_A(900, 1100), 0.2);
  EXPECT_LT(ripple_A(1200, 1350), 0.1);
}

TEST(Simulate, DitherOfTheElectronicsShowsInTheCurrent) {
  ValveUnderTest valve;
  const StepsProtocol steps{.conditions = {}, .positions_percent = {60}, .hold_s = 0.8};
  const auto ripple_A = [&] {
    const Simulation simulation = simulate(valve, plan(steps), 1);
    const std::span<const double> current = simulation.recording[Channel::current].last(200);
    return *std::max_element(current.begin(), current.end()) - *std::min_element(current.begin(), current.end());
  };
  const double still_A = ripple_A();
  valve.electronics.dither = {.amplitude_A = 0.2, .frequency_Hz = 160};
  EXPECT_GT(ripple_A(), still_A + 0.1);
}

}  // namespace
}  // namespace spoolflow::rig
