/// The band of answers that are held while samples are missing, against what the valve does meanwhile.
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"
#include "tests/sensor/linear_valve.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

constexpr double lost = NAN;
constexpr double every_s = 1e-3;

/// Slides open in a second, rests for a tenth; then the samples are missing.
Course until_they_are_missing() {
  return Course({.position_m = 0.4e-3, .pressure_difference_Pa = 60e5}).rest(0.1, 1).slide(1.4e-3, 1).rest(0.1, 0.5);
}

/// What the spool or the supply may do while nobody looks.
std::vector<Course> unseen_courses() {
  return {until_they_are_missing().slide(0.1e-3, 0.4).rest(0.5, -1),
          until_they_are_missing().slide(2.3e-3, 0.4).rest(0.5, 1), until_they_are_missing().rest(0.9, 0.5),
          until_they_are_missing().slide(1e-3, 0.5, 54e5).slide(1.8e-3, 0.4),
          until_they_are_missing().rest(0.3, 0.6, 62e5).slide(2.2e-3, 0.3).slide(1.0e-3, 0.3)};
}

/// Of the samples whose answer is held where `lose` takes away what is measured.
template <class Lose>
Judgement judge_held(const Lose& lose) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  Judgement out;
  for (const Course& course : unseen_courses()) {
    ObserverState<double> state{};
    double time_s = 0;
    for (const ValveSample& sample : ClosedFormRun(closed_form, course).sampled(course.end_s(), every_s)) {
      Sample<double> measured = sample.measured;
      time_s += every_s;
      if (time_s > until_they_are_missing().end_s()) lose(measured);
      const Estimate<double>& answer = step(valve, state, measured);
      if (has(answer.status, Status::sample_missing))
        out.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
    }
  }
  return out;
}

TEST(HeldAnswer, BandHoldsTheFlowWhateverTheSpoolDoesUnseen) {
  const Judgement held = judge_held([](Sample<double>& measured) { measured.position_m = lost; });
  ASSERT_GT(held.samples, 4000);
  EXPECT_GT(held.coverage(), 0.95);
  EXPECT_LT(held.mean_width(), 1.4) << "in the highest pressure difference 1.13 of the full scale may flow";
}

TEST(HeldAnswer, BandFollowsThePositionWhereTheCurrentAloneIsMissing) {
  const Judgement held = judge_held([](Sample<double>& measured) { measured.current_A = lost; });
  const Judgement blind = judge_held([](Sample<double>& measured) { measured.current_A = measured.position_m = lost; });
  EXPECT_GT(held.coverage(), 0.95);
  EXPECT_LT(held.mean_width(), 0.7 * blind.mean_width());
}

/// Strokes of 6 mm/s, of whose current 50 ms in each 200 are missing, and the position too where `position_m` says so.
/// Returns how many samples are answered with a fault of the position.
template <class Position>
int faults_beside_missing_currents(const Position& position_m) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  const Course course =
      until_they_are_missing().slide(2.3e-3, 0.3).slide(0.5e-3, 0.4).slide(2.3e-3, 0.3).slide(0.5e-3, 0.4);
  ObserverState<double> state{};
  int found = 0, count = 0;
  for (const ValveSample& sample : ClosedFormRun(closed_form, course).sampled(course.end_s(), every_s)) {
    Sample<double> measured = sample.measured;
    if (++count % 200 >= 150) {
      measured.current_A = lost;
      measured.position_m = position_m(measured.position_m, count);
    }
    found += has(step(valve, state, measured).status, Status::position_fault);
  }
  return found;
}

TEST(HeldAnswer, LeavesThePositionSoundWhereTheCurrentAloneIsMissing) {
  EXPECT_EQ(faults_beside_missing_currents([](double measured_m, int) { return measured_m; }), 0);
}

TEST(HeldAnswer, TakesNoPositionThatNoSpoolReachesForOneWhereTheCurrentIsMissing) {
  const auto wild = [](double measured_m, int count) { return count % 200 == 199 ? 0.0 : measured_m; };
  EXPECT_EQ(faults_beside_missing_currents(wild), 0);
}

TEST(HeldAnswer, BandOnlyOpensForAsLongAsSamplesAreMissingAndHoldsTheHeldFlow) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  const Course course = until_they_are_missing();
  ObserverState<double> state{};
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), every_s);
  for (const ValveSample& sample : run) step(valve, state, sample.measured);
  const Estimate<double> last = state.last;
  Estimate<double> before = last;
  const Sample<double> nothing{every_s, lost, lost, lost, lost};
  for (int k = 0; k < 2000; ++k) {
    const Estimate<double> held = step(valve, state, nothing);
    ASSERT_EQ(held.flow_m3_per_s, last.flow_m3_per_s);
    ASSERT_LE(held.flow_lower_m3_per_s, before.flow_lower_m3_per_s);
    ASSERT_GE(held.flow_upper_m3_per_s, before.flow_upper_m3_per_s);
    if (k == 0) {
      EXPECT_LT(held.flow_upper_m3_per_s - before.flow_upper_m3_per_s, 0.02 * closed_form.full_scale_m3_per_s());
    }
    before = held;
  }
  const double most = closed_form.flow_m3_per_s(ClosedFormValve::stroke_m, ClosedFormValve::highest_Pa, 313);
  EXPECT_LT(before.flow_upper_m3_per_s, 1.02 * most) << "no more than the valve can pass";
  EXPECT_LT(before.flow_lower_m3_per_s, 0.01 * most);
  const Estimate<double> found = step(valve, state, run.back().measured);
  EXPECT_LT(found.flow_upper_m3_per_s - found.flow_lower_m3_per_s,
            0.5 * (before.flow_upper_m3_per_s - before.flow_lower_m3_per_s));
}

TEST(HeldAnswer, TrustsThePressureLessTheLongerNobodyLooked) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  const Course course = until_they_are_missing();
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), every_s);
  const auto deviation_Pa = [&](int samples) {
    ObserverState<double> state{};
    for (const ValveSample& sample : run) step(valve, state, sample.measured);
    for (int k = 0; k < samples; ++k) step(valve, state, {every_s, lost, 0, run.back().measured.position_m, 313});
    return unobserved_change_Pa(state.pressure, valve.band.unobserved_factor);
  };
  EXPECT_GT(deviation_Pa(1000), 1.3 * deviation_Pa(10));
}

TEST(HeldAnswer, OfAWholeValveOpensToBothSidesWhereThePositionIsMissing) {
  const ClosedFormValve law{.iron = 0};
  const ObserverParameters<double> direction = closed_form_observer<double>(law);
  const WholeValveParameters<double> whole{&direction, &direction};
  const Course course = until_they_are_missing();
  WholeValveState<double> of_b{}, of_a{};
  for (const ValveSample& sample : ClosedFormRun(law, course).sampled(course.end_s(), every_s)) {
    const auto& [time_step_s, current_A, voltage_V, position_m, oil_K] = sample.measured;
    step(whole, of_b, {time_step_s, 0, current_A, 0, voltage_V, position_m, oil_K});
    step(whole, of_a, {time_step_s, current_A, 0, voltage_V, 0, -position_m, oil_K});
  }
  const double flow = of_b.open.last.flow_m3_per_s;
  const double most = law.flow_m3_per_s(ClosedFormValve::stroke_m, ClosedFormValve::highest_Pa, 313);
  for (int k = 0; k < 1000; ++k) {
    step(whole, of_b, {every_s, 0, lost, 0, 0, lost, 313});
    step(whole, of_a, {every_s, lost, 0, 0, 0, lost, 313});
  }
  const Estimate<double>&b = of_b.open.last, &a = of_a.open.last;
  EXPECT_EQ(b.flow_m3_per_s, flow);
  EXPECT_GT(b.flow_upper_m3_per_s, law.flow_m3_per_s(ClosedFormValve::stroke_m, 60e5, 313));
  EXPECT_LT(b.flow_lower_m3_per_s, -0.9 * most);
  EXPECT_NEAR(a.flow_lower_m3_per_s, -b.flow_upper_m3_per_s, 1e-9);
  EXPECT_NEAR(a.flow_upper_m3_per_s, -b.flow_lower_m3_per_s, 1e-9);
}

TEST(HeldAnswer, OfAWholeValveOpensToTheSideOnWhichItsPositionIsSeen) {
  const ClosedFormValve law{.iron = 0};
  const ObserverParameters<double> direction = closed_form_observer<double>(law);
  const WholeValveParameters<double> whole{&direction, &direction};
  const Course course = until_they_are_missing();
  WholeValveState<double> state{};
  for (const ValveSample& sample : ClosedFormRun(law, course).sampled(course.end_s(), every_s)) {
    const auto& [time_step_s, current_A, voltage_V, position_m, oil_K] = sample.measured;
    step(whole, state, {time_step_s, 0, current_A, 0, voltage_V, position_m, oil_K});
  }
  for (int k = 0; k < 5; ++k) step(whole, state, {every_s, 0, lost, 0, 0, 1.4e-3, 313});
  EXPECT_GT(state.open.last.flow_lower_m3_per_s, 0) << "the spool stands where it stood";
  step(whole, state, {every_s, 0, lost, 0, 0, -1.4e-3, 313});
  EXPECT_LT(state.open.last.flow_lower_m3_per_s, -law.flow_m3_per_s(1.4e-3, 80e5, 313));
}

/// Samples of which none can be estimated.
const std::vector<Sample<double>>& incomplete() {
  static const std::vector<Sample<double>> out{{every_s, 1, 0, lost, 313},
                                               {every_s, lost, 0, 1e-3, 313},
                                               {lost, 1, 0, 1e-3, 313},
                                               {INFINITY, 1, 0, 1e-3, 313},
                                               {-every_s, lost, 0, lost, lost}};
  return out;
}

TEST(HeldAnswer, BeforeTheFirstCompleteSampleHoldsAllThatMayFlow) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  const WholeValveParameters<double> whole{&valve, &valve};
  const double most = 0.99 * closed_form.flow_m3_per_s(ClosedFormValve::stroke_m, ClosedFormValve::highest_Pa, 313);
  for (const Sample<double>& sample : incomplete()) {
    ObserverState<double> state{};
    step(valve, state, sample);
    EXPECT_GT(state.last.flow_upper_m3_per_s, most) << sample.time_step_s;
    EXPECT_LE(state.last.flow_lower_m3_per_s, 0) << sample.time_step_s;
    EXPECT_NE(static_cast<std::uint32_t>(state.last.status) & fault_bits, 0u);

    WholeValveState<double> both{};
    step(whole, both,
         {sample.time_step_s, 0, sample.current_A, 0, sample.voltage_V, sample.position_m, sample.oil_temperature_K});
    EXPECT_GT(both.open.last.flow_upper_m3_per_s, most) << sample.time_step_s;
    EXPECT_LT(both.open.last.flow_lower_m3_per_s, -most) << sample.time_step_s;
  }
}

TEST(HeldAnswer, AfterALeapOfTimeHoldsAllThatMayFlowUntilTheNextCompleteSample) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  const Course course = until_they_are_missing();
  ObserverState<double> state{};
  for (const ValveSample& sample : ClosedFormRun(closed_form, course).sampled(course.end_s(), every_s))
    step(valve, state, sample.measured);
  step(valve, state, {2, lost, 0, 1.4e-3, 313});
  EXPECT_LE(state.last.flow_lower_m3_per_s, 0);
  EXPECT_GT(state.last.flow_upper_m3_per_s,
            0.99 * closed_form.flow_m3_per_s(ClosedFormValve::stroke_m, ClosedFormValve::highest_Pa, 313));
}

TEST(HeldAnswer, OfTheCondensedSensorOpensToAllThatMayFlow) {
  const auto tables = laid_out(linear_valve());
  CondensedState<double> state;
  const Estimate<double> before = step(tables, state, {1e-3, 1.5, 12, 1e-3, 323});
  step(tables, state, {1e-3, lost, 12, 1e-3, 323});
  EXPECT_GT(state.last.flow_upper_m3_per_s, before.flow_upper_m3_per_s);
  EXPECT_LT(state.last.flow_upper_m3_per_s, 1.1 * before.flow_upper_m3_per_s) << "a single sample says little";
  for (int k = 0; k < 1000; ++k) step(tables, state, {1e-3, lost, 12, lost, 323});
  EXPECT_EQ(state.last.flow_m3_per_s, before.flow_m3_per_s);
  EXPECT_LE(state.last.flow_lower_m3_per_s, 0);
  const double opened = step(tables, state, {1e-3, 3.2, 12, 2.4e-3, 323}).flow_m3_per_s;
  CondensedState<double> again;
  step(tables, again, {1e-3, 1.5, 12, 1e-3, 323});
  for (int k = 0; k < 1000; ++k) step(tables, again, {1e-3, lost, 12, lost, 323});
  EXPECT_GE(again.last.flow_upper_m3_per_s, opened);
}

TEST(HeldAnswer, OfTheWholeCondensedSensorOpensToBothSides) {
  const auto tables = laid_out(linear_valve());
  const WholeCondensedTables<double> whole{&tables, &tables};
  WholeCondensedState<double> state;
  const double flow = step(whole, state, {1e-3, 1.5, 0, 12, 0, -1e-3, 323}).flow_m3_per_s;
  ASSERT_LT(flow, 0);
  for (int k = 0; k < 1000; ++k) step(whole, state, {1e-3, lost, 0, 12, 0, lost, 323});
  EXPECT_EQ(state.last.flow_m3_per_s, flow);
  EXPECT_NEAR(state.last.flow_lower_m3_per_s, -state.last.flow_upper_m3_per_s, 1e-9);
  EXPECT_GT(state.last.flow_upper_m3_per_s, -flow);
  EXPECT_TRUE(has(state.last.status, Status::sample_missing));
}

}  // namespace
}  // namespace spoolflow::sensor
