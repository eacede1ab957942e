#include "spoolflow/rig/electronics/electronics.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

/// A coil of constant inductance, exact over one period.
struct ResistorAndInductor {
  double resistance_ohm = 3.0;
  double inductance_H = 0.1;
  double current_A = 0.0;
  void step(double voltage_V) {
    current_A = lagged(current_A, voltage_V / resistance_ohm, electronics_period_s, inductance_H / resistance_ohm);
  }
};

double settled_current_A(double set_A, double resistance_ohm) {
  const CurrentControl control;
  CurrentControlState state;
  ResistorAndInductor coil{.resistance_ohm = resistance_ohm};
  for (int k = 0; k < 20000; ++k) {
    coil.step(step(control, state, set_A, coil.current_A, electronics_period_s));
  }
  return coil.current_A;
}

TEST(CurrentControl, HoldsTheSetCurrentWhateverTheCoilsTemperature) {
  // One step of the duty counter is 24 V/2000 = 12 mV, 4 mA through 3 ohm.
  EXPECT_NEAR(settled_current_A(1.5, 2.7), 1.5, 5e-3);
  EXPECT_NEAR(settled_current_A(1.5, 4.0), 1.5, 5e-3);
}

TEST(CurrentControl, StaysInsideTheSupplyAndWindsUpNoFurther) {
  const CurrentControl control;
  CurrentControlState state;
  ResistorAndInductor coil{.resistance_ohm = 30};  // 24 V drive 0.8 A at most
  for (int k = 0; k < 20000; ++k) {
    const double voltage_V = step(control, state, 2.0, coil.current_A, electronics_period_s);
    ASSERT_LE(std::abs(voltage_V), control.supply_V);
    coil.step(voltage_V);
  }
  EXPECT_NEAR(coil.current_A, 0.8, 1e-3);
  EXPECT_LT(state.integral_V, control.supply_V);
}

TEST(CurrentControl, NeverAsksForMoreThanTheLargestCurrent) {
  EXPECT_NEAR(settled_current_A(100.0, 2.7), CurrentControl{}.largest_current_A, 5e-3);
  EXPECT_NEAR(settled_current_A(-1.0, 2.7), 0.0, 5e-3);
}

TEST(CurrentControl, SwitchesInWholeStepsOfItsCounter) {
  const CurrentControl control;
  CurrentControlState state;
  const double voltage_V = step(control, state, 1.0, 0.9123, electronics_period_s);
  const double steps = voltage_V / (control.supply_V / control.duty_steps);
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
}

TEST(PositionControl, FeedsTheSpringForwardAndIsOffAtZero) {
  PositionControl control;
  PositionControlState state{.lagged_position_m = 1e-3};
  const double set_A = step(control, state, 1e-3, 1e-3, electronics_period_s);
  EXPECT_DOUBLE_EQ(set_A, control.feed_forward_A + 1e-3 * control.feed_forward_A_per_m);
  EXPECT_EQ(step(control, state, 0, 1e-3, electronics_period_s), 0);
  EXPECT_FALSE(state.on);
}

TEST(PositionControl, PullsWithTheOtherSolenoidForTheOtherDirection) {
  PositionControl control;
  PositionControlState right{.lagged_position_m = 1e-3}, left{.lagged_position_m = -1e-3};
  const double right_A = step(control, right, 1.2e-3, 1e-3, electronics_period_s);
  const double left_A = step(control, left, -1.2e-3, -1e-3, electronics_period_s);
  EXPECT_GT(right_A, 0);
  EXPECT_DOUBLE_EQ(left_A, -right_A);
}

TEST(PositionControl, WindsUpWhileTheSpoolSticksUntilItsLimit) {
  PositionControl control;
  PositionControlState state{.lagged_position_m = 1e-3};
  const double error_m = 20e-6;
  const double first_A = step(control, state, 1e-3 + error_m, 1e-3, electronics_period_s);
  double last_A = first_A;
  for (int k = 0; k < 10000; ++k) {
    last_A = step(control, state, 1e-3 + error_m, 1e-3, electronics_period_s);
  }
  EXPECT_NEAR(last_A - first_A, control.integral_A_per_m_s * error_m * 1.0, 1e-9);
  for (int k = 0; k < 1000000; ++k) {
    last_A = step(control, state, 1e-3 + error_m, 1e-3, electronics_period_s);
  }
  EXPECT_NEAR(state.integral_A, control.integral_limit_A, 1e-12);
}

TEST(Electronics, EveryShapeOfDitherSwingsBetweenItsAmplitudesAboutZero) {
  constexpr int steps = 1000;
  for (const auto& [shape, mean_size] : {std::pair{DitherShape::sine, 0.6366}, std::pair{DitherShape::square, 1.0},
                                         std::pair{DitherShape::triangle, 0.5}}) {
    const Dither dither{.amplitude_A = 0.2, .frequency_Hz = 100, .shape = shape};
    double lowest_A = 1, highest_A = -1, sum_A = 0, size_A = 0;
    for (int k = 0; k < steps; ++k) {
      const double time_s = (k + 0.5) / (steps * dither.frequency_Hz);
      const double current_A = dither_A(dither, time_s);
      EXPECT_NEAR(current_A, dither_A(dither, time_s + 3 / dither.frequency_Hz), 1e-9) << "it repeats";
      EXPECT_GE(current_A * (k < steps / 2 ? 1 : -1), 0) << "all shapes have one phase";
      lowest_A = std::min(lowest_A, current_A);
      highest_A = std::max(highest_A, current_A);
      sum_A += current_A;
      size_A += std::abs(current_A);
    }
    EXPECT_NEAR(highest_A, 0.2, 1e-3);
    EXPECT_NEAR(lowest_A, -0.2, 1e-3);
    EXPECT_NEAR(sum_A / steps, 0, 1e-9);
    EXPECT_NEAR(size_A / steps, 0.2 * mean_size, 1e-4);
  }
}

TEST(Electronics, DitherSwingsTheCurrentAtItsFrequencyOnlyWhileTheValveIsDriven) {
  Electronics electronics;
  electronics.dither = {.amplitude_A = 0.2, .frequency_Hz = 100};
  electronics.current_noise_A = 0;
  electronics.position.integral_A_per_m_s = 0;
  Noise noise(1, "test");
  for (const double set_m : {0.0, 1e-3}) {
    ElectronicsState state;
    state.position.lagged_position_m = set_m;
    ResistorAndInductor coil{.inductance_H = 0.02};
    double lowest_A = 10, highest_A = -10;
    int rising = 0;
    double before_A = 0;
    for (int k = 0; k < 20000; ++k) {
      const ElectronicsInput input{.position_set_m = set_m, .position_signal_m = set_m, .current_b_A = coil.current_A};
      coil.step(step(electronics, state, input, noise).b_V);
      if (k < 10000) {
        before_A = coil.current_A;
        continue;
      }
      lowest_A = std::min(lowest_A, coil.current_A);
      highest_A = std::max(highest_A, coil.current_A);
      const double mean_A = 0.8;
      rising += before_A < mean_A && coil.current_A >= mean_A;
      before_A = coil.current_A;
    }
    if (set_m == 0) {
      EXPECT_LT(highest_A - lowest_A, 0.01);
    } else {
      EXPECT_GT(highest_A - lowest_A, 0.2);  // the loop's bandwidth takes some of the 0.4 A
      EXPECT_NEAR(rising, 100, 1);
    }
  }
}

TEST(Electronics, WhereTheSignOfTheOutputChoosesTheOtherSolenoidBrakesAFastSpool) {
  Electronics electronics;
  electronics.sign_chooses = true;
  electronics.current_noise_A = 0;
  Noise noise(1, "test");
  const auto voltages = [&](double position_m, double before_m, double current_b_A) {
    ElectronicsState state;
    state.position.lagged_position_m = before_m;
    return step(electronics, state,
                {.position_set_m = 0.5e-3, .position_signal_m = position_m, .current_b_A = current_b_A}, noise);
  };
  const SolenoidVoltages opening = voltages(0.4e-3, 0.4e-3, 0);
  EXPECT_GT(opening.b_V, 0);
  EXPECT_EQ(opening.a_V, 0);
  const SolenoidVoltages braking = voltages(1.4e-3, 1.3e-3, 0.8);
  EXPECT_GT(braking.a_V, 0);
  EXPECT_LT(braking.b_V, 0) << "what is left of the current is pulled down";
}

TEST(Electronics, AStageWithoutASetCurrentLetsGoAndThenIsOff) {
  const CurrentControl control;
  CurrentControlState state{.integral_V = 3};
  EXPECT_EQ(release(control, state, 1.0), -control.supply_V);
  EXPECT_EQ(state.integral_V, 0);
  EXPECT_EQ(release(control, state, 2e-3), 0);
}

}  // namespace
}  // namespace spoolflow::rig
