/// The whole valve of two closed-form valves, one a direction: signs, the centre, two solenoids and two paths.
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

constexpr double sample_s = 1e-3;

/// What the electronics of a whole valve have of a run to one side: the other coil is silent.
WholeValveSample<double> to_side(const Sample<double>& sample, bool side_a) {
  if (side_a) {
    return {sample.time_step_s, sample.current_A, 0, sample.voltage_V, 0, -sample.position_m, sample.oil_temperature_K};
  }
  return {sample.time_step_s, 0, sample.current_A, 0, sample.voltage_V, sample.position_m, sample.oil_temperature_K};
}

/// Two sides of a valve whose iron remembers nothing, so that no idle solenoid pulls where the truth has none.
struct Sides {
  ClosedFormValve law{.iron = 0};
  ObserverParameters<double> b = closed_form_observer<double>(law);
  ObserverParameters<double> a = closed_form_observer<double>(law);
  WholeValveParameters<double> whole{&b, &a};
};

std::vector<ValveSample> run_of(const ClosedFormValve& law, const Course& course) {
  return ClosedFormRun(law, course).sampled(course.end_s(), sample_s);
}

/// Out of the centre, to 2 mm and back into it.
Course out_and_back(double pressure_Pa) {
  return Course({.position_m = 0.05e-3, .pressure_difference_Pa = pressure_Pa})
      .rest(0.05, 1)
      .slide(2e-3, 1.5)
      .rest(0.1, -1)
      .slide(0.05e-3, 1.5);
}

TEST(WholeValve, AnswersItsMirrorImageMirrored) {
  const Sides sides;
  WholeValveState<double> right{}, left{};
  for (const ValveSample& sample : run_of(sides.law, out_and_back(60e5))) {
    const Estimate<double> of_right = step(sides.whole, right, to_side(sample.measured, false));
    Sample<double> drift_free = sample.measured;  // the sensor's drift does not turn with the valve; here there is none
    ASSERT_DOUBLE_EQ(drift_free.oil_temperature_K, ClosedFormValve::drift_free_K);
    const Estimate<double> of_left = step(sides.whole, left, to_side(drift_free, true));
    if (sample.measured.position_m < 0.04e-3) continue;  // which side is noise's
    EXPECT_NEAR(of_left.flow_m3_per_s, -of_right.flow_m3_per_s, 1e-12);
    EXPECT_NEAR(of_left.flow_lower_m3_per_s, -of_right.flow_upper_m3_per_s, 1e-12);
    EXPECT_NEAR(of_left.pressure_difference_Pa, of_right.pressure_difference_Pa, 1e-3);
    EXPECT_NEAR(of_left.magnetic_force_N, -of_right.magnetic_force_N, 1e-9);
  }
}

TEST(WholeValve, KnowsSignAndSizeOfTheFlowThroughTheCentre) {
  const Sides sides;
  WholeValveState<double> state{};
  for (const bool side_a : {false, true, false}) {
    double time_s = 0, largest = 0;
    int outside = 0, samples = 0;
    for (const ValveSample& sample : run_of(sides.law, out_and_back(side_a ? 30e5 : 60e5))) {
      time_s += sample_s;
      const Estimate<double>& answer = step(sides.whole, state, to_side(sample.measured, side_a));
      const double truth = side_a ? -sample.flow_m3_per_s : sample.flow_m3_per_s;
      if (has(answer.status, Status::closed)) {
        EXPECT_LT(std::abs(answer.flow_m3_per_s), 0.01 * sides.law.full_scale_m3_per_s());
        EXPECT_LE(answer.flow_lower_m3_per_s, 0);
        EXPECT_GE(answer.flow_upper_m3_per_s, 0);
      } else {
        EXPECT_GE(answer.flow_m3_per_s * truth, 0) << time_s;
      }
      if (time_s < 1) continue;
      largest = std::max(largest, std::abs(answer.flow_m3_per_s - truth) / sides.law.full_scale_m3_per_s());
      outside += truth < answer.flow_lower_m3_per_s || truth > answer.flow_upper_m3_per_s ? 1 : 0;
      ++samples;
    }
    EXPECT_LT(largest, 0.02) << side_a;
    EXPECT_LT(outside, 0.05 * samples) << side_a;
  }
}

TEST(WholeValve, TakesOffWhatTheIdleSolenoidsIronStillHolds) {
  const ClosedFormValve law;
  const ObserverParameters<double> direction = closed_form_observer<double>(law);
  const WholeValveParameters<double> whole{&direction, &direction};
  WholeValveState<double> state{};
  for (const ValveSample& sample : run_of(law, out_and_back(60e5))) step(whole, state, to_side(sample.measured, false));
  for (int k = 0; k < 300; ++k) step(whole, state, {sample_s, 0.3, 0, 3, 0, -0.1e-3, 313});
  ASSERT_TRUE(state.opens_a);
  // Without current the stops, which have yielded the one way and come back the other, ask for the current that the
  // magnetising current leaves over.
  double held_A = 0;
  for (int k = 0; k < ClosedFormValve::stops; ++k)
    held_A += law.stiffness_A_per_Wb() * ClosedFormValve::threshold_Wb(k);
  EXPECT_GT(state.idle.magnetic_force_N, 0.2);
  EXPECT_LE(state.idle.magnetic_force_N, law.force_per_current_N_per_A(0) * held_A + 0.01);
  const double alone_N = [&] {
    ObserverState<double> fresh{};
    for (int k = 0; k < 300; ++k) step(direction, fresh, Sample<double>{sample_s, 0.3, 3, 0.1e-3, 313});
    return fresh.last.magnetic_force_N;
  }();
  EXPECT_NEAR(-state.open.last.magnetic_force_N, alone_N - state.idle.magnetic_force_N, 1e-9);
}

TEST(WholeValve, KeepsThePressureOfEachPathAndTrustsItLessTheLongerThePathWasClosed) {
  const Sides sides;
  const auto width_after = [&](double closed_s) {
    WholeValveState<double> state{};
    for (const ValveSample& sample : run_of(sides.law, out_and_back(60e5)))
      step(sides.whole, state, to_side(sample.measured, false));
    const double known_Pa = state.open.pressure.pressure_difference_Pa;
    EXPECT_NEAR(known_Pa, 60e5, 3e5);
    for (int k = 0; k < closed_s / sample_s; ++k) step(sides.whole, state, {sample_s, 0, 0, 0, 0, -0.05e-3, 313});
    EXPECT_NE(state.open.pressure.pressure_difference_Pa, known_Pa);
    step(sides.whole, state, {sample_s, 0, 0, 0, 0, 0.05e-3, 313});
    step(sides.whole, state, {sample_s, 0, 0, 0, 0, 0.05e-3, 313});
    EXPECT_NEAR(state.open.pressure.pressure_difference_Pa, known_Pa, 1e5);
    return std::sqrt(state.open.pressure.variance_Pa2);
  };
  EXPECT_GT(width_after(10), 1.5 * width_after(1));
}

TEST(WholeValve, FindsTheZeroOfItsPositionSensorAtRestInTheCentre) {
  const Sides sides;
  WholeValveState<double> state{};
  constexpr double offset_m = 15e-6;
  for (int k = 0; k < 10 / sample_s; ++k) step(sides.whole, state, {sample_s, 0, 0, 0, 0, offset_m, 313});
  EXPECT_NEAR(state.zero_m, offset_m, 1e-6);
  WholeValveState<double> held{};
  for (int k = 0; k < 10 / sample_s; ++k) step(sides.whole, held, {sample_s, 0, 0.2, 0, 2, offset_m, 313});
  EXPECT_EQ(held.zero_m, 0) << "a spool that a solenoid holds is nowhere";
}

TEST(WholeValve, LeavesTheSignOpenNearTheCentreOfAValveWithoutOverlapAlone) {
  Sides sides;
  for (const bool overlaps : {true, false}) {
    if (!overlaps) sides.a.closed_below_m = sides.b.closed_below_m = 0;
    WholeValveState<double> state{};
    step(sides.whole, state, {sample_s, 0, 0.1, 0, 1, 3e-6, 313});
    EXPECT_EQ(has(state.open.last.status, Status::sign_undetermined), !overlaps);
    EXPECT_LE(state.open.last.flow_lower_m3_per_s, 0);
    EXPECT_GE(state.open.last.flow_upper_m3_per_s, 0);
    step(sides.whole, state, {sample_s, 0, 0.1, 0, 1, 60e-6, 313});
    EXPECT_FALSE(has(state.open.last.status, Status::sign_undetermined));
  }
}

TEST(WholeValve, HoldsItsAnswerWhereTheCurrentOfEitherCoilIsMissing) {
  const Sides sides;
  WholeValveState<double> state{};
  for (const ValveSample& sample : run_of(sides.law, out_and_back(60e5))) {
    if (sample.measured.position_m < 1e-3) continue;
    const Estimate<double> before = step(sides.whole, state, to_side(sample.measured, true));
    WholeValveSample<double> missing = to_side(sample.measured, true);
    missing.current_b_A = std::nan("");
    const Estimate<double> held = step(sides.whole, state, missing);
    EXPECT_TRUE(has(held.status, Status::sample_missing));
    EXPECT_EQ(held.flow_m3_per_s, before.flow_m3_per_s);
    break;
  }
}

TEST(Observer, NamesTheOtherDirectionInsteadOfASilentZero) {
  const ObserverParameters<double> direction = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  for (int k = 0; k < 100; ++k) step(direction, state, Sample<double>{sample_s, 0, 0, -0.05e-3, 313});
  EXPECT_FALSE(has(state.last.status, Status::other_direction)) << "drift and noise of a closed spool";
  for (int k = 0; k < 400; ++k) step(direction, state, Sample<double>{sample_s, 0, 0, -0.05e-3 - 5e-6 * k, 313});
  EXPECT_TRUE(has(state.last.status, Status::other_direction));
  EXPECT_LT(state.last.flow_lower_m3_per_s, -0.9 * closed_form.flow_m3_per_s(2.04e-3, 70e5, 313));
}

}  // namespace
}  // namespace spoolflow::sensor
