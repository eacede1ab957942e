/// What a machine does to a valve on the rig: each effect shows where it must, by its own size, and nowhere else.
#include "spoolflow/rig/bench/machine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::rig {
namespace {

using recording::Channel;

/// A valve whose bench has no ripple of its own.
ValveUnderTest smooth_valve() {
  ValveUnderTest valve = valve_preset("size_6");
  valve.plant.supply.ripple_Pa = 0;
  return valve;
}

/// The spool rests at that share of its stroke for most of `hold_s`, recorded at 10 kHz.
BenchRun rest(double percent, double hold_s) {
  return plan(StepsProtocol{.conditions = {.sample_rate_Hz = 10000}, .positions_percent = {percent}, .hold_s = hold_s});
}

/// Amplitude of the part of the last second at that whole frequency, of so many samples a second.
double amplitude_at(double frequency_Hz, std::span<const double> values, std::size_t rate_Hz = 10000) {
  double in_phase = 0, quadrature = 0;
  for (std::size_t k = 0; k < rate_Hz; ++k) {
    const double angle = 2 * std::numbers::pi * frequency_Hz * static_cast<double>(k) / static_cast<double>(rate_Hz);
    const double value = values[values.size() - rate_Hz + k];
    in_phase += value * std::cos(angle);
    quadrature += value * std::sin(angle);
  }
  return 2 * std::hypot(in_phase, quadrature) / static_cast<double>(rate_Hz);
}

/// Amplitude of the first harmonic of a triangle that is 8 % peak to peak of a current: 8/pi^2 of its height.
double first_harmonic_A(double current_A) {
  return 8 / (std::numbers::pi * std::numbers::pi) * 0.04 * current_A;
}

TEST(Machine, RippleOfThreeBarAt225HzShowsInTheTruePressureDifferenceAndNotInTheCurrent) {
  BenchRun run = rest(60, 1.6);
  run.machine.ripple = {.amplitude_bar = 3, .frequency_Hz = 225, .second_amplitude_bar = 1, .second_frequency_Hz = 25};
  const Simulation with = simulate(smooth_valve(), run, 1, {.with_truth = true});
  EXPECT_NEAR(amplitude_at(225, with.truth["pressure_difference_bar"]), 3, 0.15);
  EXPECT_NEAR(amplitude_at(25, with.truth["pressure_difference_bar"]), 1, 0.05);
  EXPECT_LT(amplitude_at(225, with.recording[Channel::current]), 0.005);
}

TEST(Machine, RippleOfThePwmShowsInTheRecordedCurrentAlone) {
  BenchRun run = rest(60, 1.2);
  const Simulation without = simulate(smooth_valve(), run, 1, {.with_truth = true});
  run.machine.pwm = {.share = 0.08, .frequency_Hz = 2003};
  const Simulation with = simulate(smooth_valve(), run, 1, {.with_truth = true});
  for (const char* const same : {"current_A", "magnetic_force_N", "position_mm", "flow_L_min"}) {
    EXPECT_EQ(with.truth[same], without.truth[same]) << same;
  }
  const double harmonic_A = first_harmonic_A(with.truth["current_A"].back());
  EXPECT_NEAR(amplitude_at(2003, with.recording[Channel::current]), harmonic_A, 0.05 * harmonic_A);
  EXPECT_LT(amplitude_at(2003, without.recording[Channel::current]), 0.05 * harmonic_A);
}

TEST(Machine, PwmSampledAtOneKilohertzBeatsAtTheDifferenceToTheNextMultiple) {
  BenchRun run = plan(StepsProtocol{.conditions = {}, .positions_percent = {60}, .hold_s = 1.4});
  run.machine.pwm = {.share = 0.08, .frequency_Hz = 2120};
  const Simulation with = simulate(smooth_valve(), run, 1, {.with_truth = true});
  const double harmonic_A = first_harmonic_A(with.truth["current_A"].back());
  EXPECT_NEAR(amplitude_at(120, with.recording[Channel::current], 1000), harmonic_A, 0.1 * harmonic_A);
  EXPECT_LT(amplitude_at(121, with.recording[Channel::current], 1000), 0.2 * harmonic_A);
}

TEST(Machine, SpikesAreSingleSamplesOffByTheirHeightAndNothingElseChanges) {
  BenchRun run = plan(StepsProtocol{.conditions = {.sample_rate_Hz = 10000}, .positions_percent = {60}, .hold_s = 2});
  const Simulation without = simulate(smooth_valve(), run, 1, {.with_truth = true});
  run.machine.spikes = {.share = 0.01, .height_A = 0.7};
  const Simulation with = simulate(smooth_valve(), run, 1, {.with_truth = true});
  EXPECT_EQ(with.truth["flow_L_min"], without.truth["flow_L_min"]);
  const std::span<const double> spoilt_A = with.recording[Channel::current],
                                sound_A = without.recording[Channel::current];
  std::size_t up = 0, down = 0;
  for (std::size_t k = 0; k < sound_A.size(); ++k) {
    const double off_A = spoilt_A[k] - sound_A[k];
    EXPECT_TRUE(off_A == 0 || std::abs(std::abs(off_A) - 0.7) < 1e-12) << off_A;
    (off_A > 0 ? up : down) += off_A != 0;
  }
  EXPECT_NEAR(static_cast<double>(up + down) / static_cast<double>(sound_A.size()), 0.01, 0.003);
  EXPECT_GT(std::min(up, down), (up + down) / 4);
}

TEST(Machine, VibrationPushesSpoolAndArmaturesByTheirMassTimesTheAcceleration) {
  ValveUnderTest valve = smooth_valve();
  BenchRun run = rest(0, 1.2);  // stages off: friction and springs alone hold the body
  run.machine.vibration = {.acceleration_g = 0.9, .frequency_Hz = 35};
  const Simulation with = simulate(valve, run, 1, {.with_truth = true});
  std::vector<double> held_N(with.truth.size());
  for (const char* const force :
       {"spool_friction_force_N", "armature_friction_force_N", "spring_force_N", "drag_force_N"}) {
    std::transform(held_N.begin(), held_N.end(), with.truth[force].begin(), held_N.begin(), std::plus<>());
  }
  const double mass_kg = valve.plant.spool.spool_mass_kg + 2 * valve.plant.spool.armature_mass_kg;
  const double push_N = mass_kg * 0.9 * 9.80665;
  EXPECT_NEAR(amplitude_at(35, held_N), push_N, 0.03 * push_N);
}

TEST(Machine, AnActuatorAtItsEndLeavesNeitherFlowNorPressureDifferenceAtAnOpenValve) {
  BenchRun run = rest(60, 3);
  run.machine.actuator_end = {.stands_s = 0.8, .begin_s = 1, .every_s = 1.5};
  const Simulation with = simulate(smooth_valve(), run, 1, {.with_truth = true});
  const auto at = [&](const char* column, double time_s) {
    return with.truth[column][static_cast<std::size_t>(std::llround(1e4 * time_s))];
  };
  for (const double standing_s : {1.6, 3.1}) {
    EXPECT_GT(at("position_mm", standing_s), 1.2);
    EXPECT_LT(std::abs(at("flow_L_min", standing_s)), 0.1);
    EXPECT_LT(std::abs(at("pressure_difference_bar", standing_s)), 0.01);
  }
  for (const double moving_s : {0.9, 2.3}) {
    EXPECT_GT(at("flow_L_min", moving_s), 20);
    EXPECT_NEAR(at("pressure_difference_bar", moving_s), 60, 1);
  }
}

TEST(Machine, AnActuatorStandsWhenTheOilHasFilledItsStroke) {
  BenchRun run = rest(60, 2);
  run.machine.actuator_end = {.stands_s = 10, .stroke_m = 0.3, .piston_area_m2 = 1e-3};
  const Simulation with = simulate(smooth_valve(), run, 1, {.with_truth = true});
  const std::vector<double>& flow_L_min = with.truth["flow_L_min"];
  double passed_m3 = 0;
  for (const double flow : flow_L_min) passed_m3 += flow / 60000 * 1e-4;
  const double settling_m3 =
      2 * 0.010 * 40 / 60000;  // what passes while the port's pressure rises: a square root's tail
  EXPECT_NEAR(passed_m3, 0.3e-3 + 0.5 * settling_m3, 0.5 * settling_m3 + 0.01e-3);
  EXPECT_LT(std::abs(flow_L_min.back()), 0.1);
}

TEST(Machine, AllOffLeavesThePlantToItself) {
  PumpRipple ripple;
  EXPECT_EQ(pump_ripple_Pa(ripple, 0.123), 0.0);
  EXPECT_EQ(vibration_force_N({}, 0.17, 0.123), 0.0);
  ActuatorAtEnd actuator{{}};
  EXPECT_EQ(actuator.share(1, 1e-3, 1e-4), 1.0);
}

}  // namespace
}  // namespace spoolflow::rig
