/// The whole valve on the rig: both directions, both coils, every edge.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/rig/bench/campaign_loads.hpp"
#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::rig {
namespace {

using recording::Channel;

/// Both sides alike, with a position sensor whose zero stays.
ValveUnderTest symmetric_valve() {
  ValveUnderTest valve;
  valve.whole = true;
  valve.instruments.lvdt.zero_offset_m = 0;
  valve.instruments.lvdt.zero_drift_per_K = 0;
  return as_built(valve);
}

Simulation moved(const ValveUnderTest& valve, std::vector<double> positions_percent, double hold_s = 0.5) {
  StepsProtocol steps{.conditions = {.port_pressures = true}, .positions_percent = std::move(positions_percent)};
  steps.hold_s = hold_s;
  return simulate(valve, plan(steps, valve, 1), 1, {.with_truth = true});
}

TEST(WholeValve, ItsFlowHasTheSignOfItsOpeningAndPassesBothEdgesOfThePath) {
  const ValveUnderTest valve = symmetric_valve();
  for (const double side : {1.0, -1.0}) {
    const Simulation run = moved(valve, {60 * side});
    const auto last = [&](std::string_view header) { return run.truth[header].back(); };
    EXPECT_NEAR(last("position_mm"), side * 1.44, 0.1);
    EXPECT_GT(side * last("flow_L_min"), 15);
    EXPECT_NEAR(side * run.recording[Channel::flow_reference].back() * 6e4, side * last("flow_L_min"), 1);
    const double inlet = last(side > 0 ? "flow_PB_L_min" : "flow_PA_L_min");
    const double outlet = last(side > 0 ? "flow_AT_L_min" : "flow_BT_L_min");
    EXPECT_NEAR(inlet, outlet, 0.2) << "the supply's ripple fills and empties the hose";
    EXPECT_NEAR(inlet, side * last("flow_L_min"), 0.3) << "but for what leaks past the closed edges";
    EXPECT_LT(last(side > 0 ? "flow_PA_L_min" : "flow_PB_L_min"), 0.3);
    EXPECT_NEAR(last("pressure_difference_bar"), 60, 1);
    EXPECT_NEAR(last("pressure_p_bar") - last("pressure_a_bar"), 30, 1) << "half of it over each of two equal edges";
    EXPECT_NEAR(run.recording[Channel::pressure_a].back() / 1e5, last("pressure_a_bar"), 0.5);
    EXPECT_GT(side * last("flow_force_N"), 5) << "it closes either way";
    EXPECT_GT(side * last("spring_force_N"), 10);
  }
}

TEST(WholeValve, BothDirectionsOfASymmetricValveAreMirrorImages) {
  ValveUnderTest valve = symmetric_valve();
  valve.instruments.lvdt.noise_m = 0;
  valve.instruments.lvdt.resolution_m = 0;
  valve.electronics.current_noise_A = 0;
  const Simulation b = moved(valve, {70}, 0.3), a = moved(valve, {-70}, 0.3);
  for (const auto& [one, other, sign] : {std::tuple{"flow_L_min", "flow_L_min", -1.0},
                                         {"position_mm", "position_mm", -1.0},
                                         {"current_b_A", "current_a_A", 1.0},
                                         {"flow_PB_L_min", "flow_PA_L_min", 1.0},
                                         {"flow_force_N", "flow_force_N", -1.0}}) {
    const double value = b.truth[one].back();
    EXPECT_NEAR(a.truth[other].back(), sign * value, 1e-3 * std::abs(value)) << one;
  }
}

TEST(WholeValve, WithinTheOverlapNothingReachesThePortsButLeakageRunsToTank) {
  const ValveUnderTest valve = symmetric_valve();  // overlap: 6.25 % of the stroke
  for (const double percent : {0.0, 4.0, -4.0}) {
    const Simulation run = moved(valve, {percent}, 1.0);
    EXPECT_LT(std::abs(run.truth["flow_L_min"].back()), 0.1) << percent;
    EXPECT_GT(run.truth["flow_PB_L_min"].back(), 1e-4) << percent;
    EXPECT_GT(run.truth["flow_PA_L_min"].back(), 1e-4) << percent;
    EXPECT_NEAR(run.truth["flow_PB_L_min"].back() + run.truth["flow_PA_L_min"].back(),
                run.truth["flow_AT_L_min"].back() + run.truth["flow_BT_L_min"].back(), 1e-3);
  }
}

TEST(WholeValve, TheIdleSolenoidHasNoCurrentButKeepsFlux) {
  const ValveUnderTest valve = symmetric_valve();
  const Simulation fresh = moved(valve, {60}), used = moved(valve, {-80, 60});
  EXPECT_NEAR(used.recording[Channel::current_a].back(), 0, 3e-3);
  EXPECT_EQ(fresh.truth["flux_linkage_a_Wb"].back(), 0);
  EXPECT_GT(std::abs(used.truth["flux_linkage_a_Wb"].back()), 1e-5);
  EXPECT_GT(used.truth["magnetic_force_a_N"].back(), 0);
}

TEST(WholeValve, BothCoilsCarryCurrentBrieflyWhenTheSolenoidsChange) {
  const Simulation run = moved(symmetric_valve(), {-80, 80});
  const auto current_a = run.recording[Channel::current_a], current_b = run.recording[Channel::current_b];
  int both = 0;
  for (std::size_t i = 0; i < current_a.size(); ++i) both += current_a[i] > 0.05 && current_b[i] > 0.05;
  EXPECT_GE(both, 1);
  EXPECT_LE(both, 30);  // samples of 1 ms
  EXPECT_GT(*std::max_element(current_a.begin(), current_a.end()), 1);
  EXPECT_GT(*std::max_element(current_b.begin(), current_b.end()), 1);
}

TEST(WholeValve, DitherIsOnTheActiveCoilAlone) {
  ValveUnderTest valve = symmetric_valve();
  valve.electronics.dither = {.amplitude_A = 0.2, .frequency_Hz = 130};
  const Simulation run = moved(valve, {-60}, 0.8);
  const auto swing_A = [&](Channel channel) {
    const std::span<const double> last = run.recording[channel].last(200);
    return *std::max_element(last.begin(), last.end()) - *std::min_element(last.begin(), last.end());
  };
  EXPECT_GT(swing_A(Channel::current_a), 0.1);
  EXPECT_LT(swing_A(Channel::current_b), 0.01);
}

/// A cylinder with that area at port A, moved by a steady load while the supply holds 50 bar.
Simulation under_load(double area_A_m2, double load_N, double percent) {
  ValveUnderTest valve = symmetric_valve();
  Load& load = valve.plant.load;
  load.kind = LoadKind::cylinder;
  load.cylinder_stroke_m = 2.5;
  load.piston_area_B_m2 = 3e-2;
  load.piston_area_A_m2 = area_A_m2;
  load.cylinder_mass_kg = 3000;
  StepsProtocol steps{.conditions = {.supply_pressure_bar = 50}, .positions_percent = {percent}};
  steps.hold_s = 1.2;
  BenchRun run = plan(steps, valve, 1);
  run.load_force_N = Course(load_N);
  return simulate(valve, run, 1, {.with_truth = true});
}

TEST(WholeValve, ADifferentialCylinderSendsItsAreaRatioOverTheSecondEdge) {
  for (const double side : {1.0, -1.0}) {
    const Simulation run = under_load(1.8e-2, 0, 70 * side);
    const double at_B = run.truth["flow_PB_L_min"].back() - run.truth["flow_BT_L_min"].back();
    const double at_A = run.truth["flow_AT_L_min"].back() - run.truth["flow_PA_L_min"].back();
    EXPECT_GT(side * at_B, 10);
    EXPECT_NEAR(at_A / at_B, 0.6, 0.01);
    EXPECT_NEAR(run.truth["flow_L_min"].back(), side > 0 ? at_B : at_A, 1e-6) << "the flow is that of the fed port";
  }
}

TEST(WholeValve, AnOverrunningLoadLeavesMoreThanTheSupplyOverBothEdges) {
  const double holding_N = 20e5 * 3e-2;
  const Simulation hindered = under_load(3e-2, holding_N, 60), helped = under_load(3e-2, -holding_N, 60);
  EXPECT_GT(hindered.truth["flow_L_min"].back(), 5);
  EXPECT_GT(helped.truth["flow_L_min"].back(), 1.3 * hindered.truth["flow_L_min"].back());
  EXPECT_NEAR(hindered.truth["pressure_difference_bar"].back(), 29, 4);
  EXPECT_NEAR(helped.truth["pressure_difference_bar"].back(), 69, 4);
}

TEST(WholeValve, ALoadBeyondTheSupplyDrivesOilBackAndItsForceClosesAllTheSame) {
  const Simulation run = under_load(3e-2, 1.5 * 50e5 * 3e-2, 60);
  EXPECT_GT(run.truth["position_mm"].back(), 1.2);
  EXPECT_LT(run.truth["flow_L_min"].back(), -5);
  EXPECT_GT(run.truth["flow_force_PB_N"].back(), 2);
}

std::string bytes_of(const ValveUnderTest& valve, AxialForceProtocol protocol) {
  protocol.pressure_differences_bar = {30};
  protocol.rate_percent_per_s = 100;
  const BenchRun run = plan(protocol, valve, 1);
  std::ostringstream text;
  const Simulation simulation = simulate(valve, run, 1, {.with_truth = true});
  write_recording(text, simulation.recording, run);
  write_truth(text, simulation.truth);
  return text.str();
}

TEST(WholeValveOnTheBench, OfASymmetricValveBothDirectionsShowTheSameBytes) {
  const ValveUnderTest valve = symmetric_valve();
  EXPECT_EQ(bytes_of(valve, {}), bytes_of(turned_round(valve), {}));
  ValveUnderTest uneven = valve;
  uneven.plant.spring_a.preload_N += 1;
  EXPECT_NE(bytes_of(uneven, {}), bytes_of(turned_round(uneven), {}));
}

TEST(WholeValveOnTheBench, TheInletAloneIsTheBenchOfAValveOfOneDirection) {
  ValveUnderTest one = symmetric_valve();
  one.whole = false;
  one.plant.load.kind = LoadKind::held_difference;
  EXPECT_EQ(bytes_of(one, {}), bytes_of(symmetric_valve(), {.load = LoadKind::held_difference}));
}

/// What the bench says at full opening, after the ramp.
struct FullyOpen {
  double flow_L_min, flow_force_N;
};

FullyOpen fully_open(const ValveUnderTest& valve, LoadKind load, double difference_bar) {
  const AxialForceProtocol protocol{
      .pressure_differences_bar = {difference_bar}, .rate_percent_per_s = 100, .load = load};
  const Simulation run = simulate(valve, plan(protocol, valve, 1), 1, {.with_truth = true});
  const std::size_t at = 150;  // ramp of 1 s, hold of 1 s, 100 Hz
  EXPECT_NEAR(run.truth["pressure_difference_bar"][at], difference_bar, 0.5);
  EXPECT_NEAR(run.recording[Channel::pressure_upstream][at] - run.recording[Channel::pressure_downstream][at],
              difference_bar * 1e5, 0.5e5);
  return {run.truth["flow_L_min"][at], run.truth["flow_force_N"][at]};
}

TEST(WholeValveOnTheBench, JoinedPortsShowTheForcesOfBothEdgesAtHalfTheDifferenceEach) {
  const ValveUnderTest valve = symmetric_valve();
  const FullyOpen inlet = fully_open(valve, LoadKind::held_difference, 30),
                  outlet = fully_open(valve, LoadKind::held_return, 30);
  const FullyOpen path = fully_open(valve, LoadKind::held_path, 60);
  EXPECT_NEAR(inlet.flow_L_min / path.flow_L_min, 1, 0.01);
  EXPECT_NEAR(outlet.flow_L_min / path.flow_L_min, 1, 0.01);
  EXPECT_GT(outlet.flow_force_N, 10);
  EXPECT_NEAR((inlet.flow_force_N + outlet.flow_force_N) / path.flow_force_N, 1, 0.02);
}

}  // namespace
}  // namespace spoolflow::rig
