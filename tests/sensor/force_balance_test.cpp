/// The balance of forces at a pressure difference that is right, and at one that is wrong, against forces in closed
/// form.
#include "spoolflow/sensor/force_balance.hpp"

#include <gtest/gtest.h>

#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::sensor {
namespace {

constexpr double opened_m = 1.2e-3;
constexpr double loaded_Pa = 60e5;
constexpr double armature_sliding_N = 1.1;

/// A spool on which `friction_N` acts, taken for one with another pressure difference by `wrong_Pa`.
struct Balance {
  ForceBalance<double> of(PositionPoint<double> point, double friction_N, double wrong_Pa = 0) {
    point.position_m = opened_m;
    ActuatorEstimate<double> actuator{};
    actuator.magnetic_force_N =
        ClosedFormValve::spring_N(opened_m) + ClosedFormValve::flow_force_N(opened_m, loaded_Pa) + friction_N;
    actuator.friction_half_width_N = armature_sliding_N;
    actuator.uncertainty_N = 0.2;
    const EdgePoint<double> edge = valve.edge.at(ClosedFormValve::drift_free_K, loaded_Pa + wrong_Pa, opened_m);
    return balance_forces(valve, {contacts, swing}, {actuator, valve.spring.at(opened_m).value, edge, 1.0}, point,
                          Dither<double>{}, {false, {true, 1e-3}, 0.0, 1e-3});
  }
  ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  FrictionState<double> contacts{};
  FrictionSwingState<double> swing{};
};

PositionPoint<double> moving(Motion motion, double direction) {
  return {opened_m, motion, direction * 1e-6};
}
PositionPoint<double> resting() {
  return moving(Motion::rest, 1);
}

double sliding_friction_N(double pressure_Pa) {
  return ClosedFormValve::spool_friction_N(pressure_Pa, ClosedFormValve::drift_free_K) + armature_sliding_N;
}

TEST(ForceBalance, LeavesTheFrictionThatIsThereAtTheRightPressureDifference) {
  for (const PositionPoint<double>& point :
       {resting(), moving(Motion::transient, 1), moving(Motion::opening, 1), moving(Motion::closing, -1)}) {
    for (const double friction_N : {-3.0, 0.0, 2.0}) {
      EXPECT_NEAR(Balance{}.of(point, friction_N).residual_force_N, friction_N, 1e-9);
    }
  }
}

/// The spool slid with its friction, 8 ms long; now another force is left while the position still shows it slide.
double noise_after_N(double earlier_N, double now_N, double direction) {
  Balance valve;
  const PositionPoint<double> point = moving(direction > 0 ? Motion::opening : Motion::closing, direction);
  for (int k = 0; k < 8; ++k) (void)valve.of(point, direction * earlier_N);
  return valve.of(point, direction * now_N).noise_N;
}

TEST(ForceBalance, IsNoSurerThanWhatFrictionHasLostWhileThePositionStillShowsASlide) {
  const double sliding_N = sliding_friction_N(loaded_Pa);
  for (const double direction : {1.0, -1.0}) {
    const double steady_N = noise_after_N(sliding_N, sliding_N, direction);
    EXPECT_NEAR(noise_after_N(sliding_N, 0.95 * sliding_N, direction), steady_N, 1e-9);
    EXPECT_NEAR(noise_after_N(2 * sliding_N, sliding_N, direction), steady_N, 1e-9) << "it stuck before";
    EXPECT_NEAR(noise_after_N(sliding_N, 1.5 * sliding_N, direction), steady_N, 1e-9) << "pressed on";
    EXPECT_GT(noise_after_N(sliding_N, 0, direction), 0.85 * sliding_N);
    EXPECT_GT(noise_after_N(sliding_N, -sliding_N, direction), 1.85 * sliding_N);
  }
}

TEST(ForceBalance, HasTheInnovationOfFlowForceAndFrictionWhereTheSpoolSlidesAtAWrongPressureDifference) {
  constexpr double friction_per_pressure = 2e-7 * (1 - 0.1 * 0.25);
  for (const double direction : {1.0, -1.0}) {
    const PositionPoint<double> point = moving(direction > 0 ? Motion::opening : Motion::closing, direction);
    for (const double wrong_Pa : {0.0, 6e5, -6e5}) {
      const ForceBalance<double> balance = Balance{}.of(point, direction * sliding_friction_N(loaded_Pa), wrong_Pa);
      EXPECT_TRUE(balance.sliding);
      // Too much pressure means too much flow force, which closes, and too much friction, which hinders the motion.
      const double slope = ClosedFormValve::flow_force_per_pressure(opened_m) + direction * friction_per_pressure;
      EXPECT_NEAR(balance.residual_force_N - balance.friction_N, -wrong_Pa * slope, 1e-9);
    }
  }
}

TEST(ForceBalance, KeepsFrictionAtRestWithinWhatTheContactsHold) {
  for (const double wrong_Pa : {20e5, -20e5}) {
    Balance spool;
    const ForceBalance<double> balance = spool.of(resting(), 0.5 * sliding_friction_N(loaded_Pa), wrong_Pa);
    EXPECT_FALSE(balance.sliding);
    EXPECT_LE(balance.resting.lower_N, balance.friction_N);
    EXPECT_LE(balance.friction_N, balance.resting.upper_N);
    EXPECT_LE(std::abs(balance.friction_N), balance.bounds.sticking_N + 2 * spool.valve.friction.tolerance_N);
    EXPECT_GE(balance.bounds.sticking_N, balance.bounds.sliding_N);
    EXPECT_GT(std::abs(balance.residual_force_N - balance.friction_N), 1);
  }
}

TEST(ForceBalance, GivesTheMassItsShareOfTheForceAndIsNoSurerOfItThanItsSize) {
  PositionPoint<double> point = moving(Motion::opening, 1);
  const ForceBalance<double> even = Balance{}.of(point, 4.0);
  point.acceleration_m_per_s2 = 20;
  const ForceBalance<double> accelerated = Balance{}.of(point, 4.0);
  const double inertia_N = Balance{}.valve.moving_mass_kg * 20;
  EXPECT_NEAR(even.residual_force_N - accelerated.residual_force_N, inertia_N, 1e-9);
  EXPECT_NEAR(accelerated.noise_N, std::hypot(even.noise_N, inertia_N), 1e-9);
}

}  // namespace
}  // namespace spoolflow::sensor
