/// The solenoid as a force sensor, against the force that was there.
#include "spoolflow/sensor/actuator.hpp"

#include <gtest/gtest.h>

#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

Course strokes() {
  Course course({.position_m = 0.4e-3});
  course.rest(0.1, 1);
  for (int k = 0; k < 3; ++k) course.slide(2.2e-3, 0.8).rest(0.1, -1).slide(0.5e-3, 0.8).rest(0.1, 1);
  return course;
}

TEST(Actuator, StatesTheMagneticForceWithinItsUncertainty) {
  const Course course = strokes();
  const ActuatorParameters<double> actuator = closed_form_actuator<double>(closed_form);
  for (const double step_s : {50e-6, 1e-3, 5e-3}) {
    const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s);
    ActuatorState<double> state{};
    int within = 0;
    double largest_N = 0;
    for (std::size_t k = 0; k < run.size(); ++k) {
      Sample<double> sample = run[k].measured;
      sample.position_m = run[k].truth.position_m;
      const ActuatorEstimate<double> out = step(actuator, state, sample, k == 0);
      const double error_N = out.magnetic_force_N - run[k].magnetic_force_N;
      within += std::abs(error_N) < 2 * out.uncertainty_N ? 1 : 0;
      if (static_cast<double>(k) * step_s > 2) largest_N = std::max(largest_N, std::abs(error_N));
      EXPECT_TRUE(out.inside_map);
      EXPECT_NEAR(out.friction_half_width_N, ClosedFormValve::armature_friction_N(run[k].magnetising_A), 0.05);
    }
    EXPECT_GT(within, 0.95 * static_cast<double>(run.size())) << step_s;
    EXPECT_LT(largest_N, 0.3) << step_s;  // hysteresis alone is 1 N either way
  }
}

TEST(Actuator, DoubtsItsForceUntilASwingOfTheFluxHasWipedOutItsHistory) {
  const Course course = strokes();
  const ActuatorParameters<double> actuator = closed_form_actuator<double>(closed_form);
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), 1e-3);
  ActuatorState<double> state{};
  double first_N = 0, last_N = 0;
  for (std::size_t k = 0; k < run.size(); ++k) {
    last_N = step(actuator, state, run[k].measured, k == 0).uncertainty_N;
    if (k == 0) first_N = last_N;
  }
  const double slope_N_per_A = closed_form.force_per_current_N_per_A(0.4e-3);
  EXPECT_NEAR(first_N, std::hypot(0.2, slope_N_per_A * actuator.coercive_current_A), 0.1);
  EXPECT_LT(last_N, 0.3);
  EXPECT_DOUBLE_EQ(unknown_memory_A(actuator, state), 0);
}

TEST(Actuator, BeginsInTheMiddleOfItsLoopsWhateverWayTheCurrentCame) {
  const Course course = strokes();
  const ActuatorParameters<double> actuator = closed_form_actuator<double>(closed_form);
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), 1e-3);
  double largest_A = 0, lowest_A = 0;
  for (std::size_t k = run.size() / 2; k < run.size(); k += 100) {
    ActuatorState<double> state{};
    Sample<double> sample = run[k].measured;
    sample.position_m = run[k].truth.position_m;
    const ActuatorEstimate<double> out = step(actuator, state, sample, true);
    const double error_A = (out.magnetic_force_N - run[k].magnetic_force_N) / out.force_per_current_N_per_A;
    largest_A = std::max(largest_A, error_A);
    lowest_A = std::min(lowest_A, error_A);
  }
  const double coercive_A = actuator.coercive_current_A;
  EXPECT_LT(largest_A, 1.2 * coercive_A);
  EXPECT_GT(lowest_A, -1.2 * coercive_A);
  EXPECT_GT(largest_A, 0.5 * coercive_A);  // the current came down
  EXPECT_LT(lowest_A, -0.5 * coercive_A);  // it came up
}

TEST(Actuator, SaysWhereItsMapEnds) {
  const ActuatorParameters<double> actuator = closed_form_actuator<double>(closed_form);
  ActuatorState<double> state{};
  EXPECT_FALSE(step(actuator, state, {1e-3, 3.2, NAN, 1e-3, NAN}, true).inside_map);
  EXPECT_FALSE(step(actuator, state, {1e-3, 1.0, NAN, 2.6e-3, NAN}, true).inside_map);
  EXPECT_TRUE(step(actuator, state, {1e-3, 1.0, NAN, 1e-3, NAN}, true).inside_map);
}

}  // namespace
}  // namespace spoolflow::sensor
