/// The balance of forces at a pressure difference that is right, and at one that is wrong, against the forces that were
/// there.
#include "spoolflow/sensor/force_balance.hpp"

#include <gtest/gtest.h>

#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

/// Walks a course with the pressure difference held at what it is plus `wrong_Pa`; `each` sees truth and balance.
template <class Each>
void balance_along(const Course& course, double step_s, double wrong_Pa, const Each& each) {
  const ObserverParameters<double> parameters = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  double time_s = 0;
  bool begins = true;
  for (const ValveSample& now : ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s)) {
    time_s += step_s;
    state.oil_temperature_K = now.truth.oil_temperature_K;
    state.pressure.pressure_difference_Pa = now.truth.pressure_difference_Pa + wrong_Pa;
    state.pressure.friction_ratio = 1;
    if (begins) begin(state.position, now.measured.position_m);
    const Dither<double> dither =
        follow_dither(state.dither, now.measured.current_A, parameters.largest_current_A, step_s);
    const PositionPoint<double> position = track(parameters.position_sensor, state.position, now.measured, {},
                                                 state.oil_temperature_K, dither, state.swing.frees);
    each(time_s, now, balance_forces(parameters, state, now.measured, position, dither, 0.0, begins));
    begins = false;
  }
}

TEST(ForceBalance, LeavesTheFrictionThatWasThereAtTheRightPressure) {
  Course course({.position_m = 0.4e-3});
  course.rest(0.1, 1).slide(2.0e-3, 0.8).rest(0.4, -0.5).rest(0.2, -1).slide(0.6e-3, 0.8);
  for (const double step_s : {50e-6, 200e-6, 1e-3, 5e-3}) {
    int within = 0, samples = 0;
    double largest_N = 0;
    balance_along(course, step_s, 0, [&](double time_s, const ValveSample& now, const ForceBalance<double>& balance) {
      if (time_s < 0.5) return;
      const double error_N = balance.apparent_friction_N - now.friction_N;
      largest_N = std::max(largest_N, std::abs(error_N));
      within += std::abs(error_N) < 2 * balance.noise_N ? 1 : 0;
      ++samples;
    });
    EXPECT_GT(within, 0.95 * samples) << step_s;
    EXPECT_LT(largest_N, 0.8) << step_s;
  }
}

TEST(ForceBalance, HasNoInnovationAtTheRightPressureWhileTheSpoolSlidesAndTheFlowForcesShareAtAWrongOne) {
  Course course({.position_m = 0.4e-3});
  course.rest(0.1, 1).slide(2.2e-3, 1.5);
  for (const double wrong_Pa : {0.0, 6e5, -6e5}) {
    int sliding = 0;
    balance_along(
        course, 1e-3, wrong_Pa, [&](double time_s, const ValveSample& now, const ForceBalance<double>& balance) {
          if (time_s < 0.4 || !balance.sliding) return;
          ++sliding;
          // Too much pressure means too much flow force, which closes, and too much friction, which hinders the
          // opening.
          const double expected_N =
              -wrong_Pa * (ClosedFormValve::flow_force_per_pressure(now.truth.position_m) + 2e-7 * (1 - 0.1 * 0.25));
          EXPECT_NEAR(balance.apparent_friction_N - balance.friction_N, expected_N, 0.35) << time_s;
        });
    EXPECT_GT(sliding, 1000);
  }
}

TEST(ForceBalance, KeepsFrictionAtRestWithinWhatTheContactsHold) {
  Course course({.position_m = 0.4e-3});
  course.rest(0.1, 1).slide(2.0e-3, 0.8).rest(1.0, -0.8);
  balance_along(course, 1e-3, 20e5, [&](double time_s, const ValveSample&, const ForceBalance<double>& balance) {
    if (time_s < 1.2) return;
    EXPECT_FALSE(balance.sliding);
    EXPECT_LE(balance.resting.lower_N, balance.friction_N);
    EXPECT_LE(balance.friction_N, balance.resting.upper_N);
    EXPECT_LE(std::abs(balance.friction_N), balance.bounds.sticking_N + 2 * 0.7);
    EXPECT_GE(balance.bounds.sticking_N, balance.bounds.sliding_N);
  });
}

}  // namespace
}  // namespace spoolflow::sensor
