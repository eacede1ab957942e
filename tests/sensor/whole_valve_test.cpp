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
      const Estimate<double> answer = step(sides.whole, state, to_side(sample.measured, side_a));
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
    step(direction, fresh, Sample<double>{sample_s, 0, 0, 0.1e-3, 313});  // the other coil began without current, too
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

TEST(WholeValve, DoubtsAFlowToWhichTheCylinderBehindItHasNotSettled) {
  Sides sides;
  sides.a.unsettled_load_share = sides.b.unsettled_load_share = 0.4;
  const Sides equal_flows;
  WholeValveState<double> cylinder{}, motor{};
  Course course({.position_m = 0.4e-3, .pressure_difference_Pa = 60e5});
  course.rest(2, 1).slide(2e-3, 0.1).rest(2, 1);
  double before = 0, moving = 0, time_s = 0;
  for (const ValveSample& sample : run_of(sides.law, course)) {
    time_s += sample_s;
    const Estimate<double> answer = step(sides.whole, cylinder, to_side(sample.measured, true));
    const Estimate<double> sure = step(equal_flows.whole, motor, to_side(sample.measured, true));
    EXPECT_EQ(answer.flow_m3_per_s, sure.flow_m3_per_s);
    const auto added = [&](double end, double sure_end) {  // by the load alone
      return std::sqrt(squared(answer.flow_m3_per_s - end) - squared(answer.flow_m3_per_s - sure_end));
    };
    const double below = added(answer.flow_lower_m3_per_s, sure.flow_lower_m3_per_s);
    if (time_s < 2) before = below;
    if (time_s > 2) moving = std::max(moving, below);
    if (below > 1e-7) {
      EXPECT_NEAR(added(answer.flow_upper_m3_per_s, sure.flow_upper_m3_per_s) / below, 1, 1e-3);
    }
  }
  const double end = motor.open.last.flow_m3_per_s - cylinder.open.last.flow_lower_m3_per_s;
  const double sure_end = motor.open.last.flow_m3_per_s - motor.open.last.flow_lower_m3_per_s;
  EXPECT_LT(before, 0.01 * sides.law.full_scale_m3_per_s());
  EXPECT_GT(moving, 0.3 * 0.4 * std::abs(motor.open.last.flow_m3_per_s));
  EXPECT_NEAR(end, sure_end, 0.02 * sure_end);  // settled
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

/// A run to one side that ends open, without port pressures.
WholeValveState<double> opened(const Sides& sides, bool side_a) {
  WholeValveState<double> state{};
  const Course course = Course({.position_m = 0.05e-3, .pressure_difference_Pa = 60e5}).slide(1.5e-3, 1.5);
  for (const ValveSample& sample : run_of(sides.law, course))
    step(sides.whole, state, to_side(sample.measured, side_a));
  return state;
}

WholeValveSample<double> held_open(const Sides& sides, bool side_a) {
  const Course course = Course({.position_m = 1.5e-3, .pressure_difference_Pa = 60e5}).rest(0.02, 1);
  return to_side(run_of(sides.law, course).back().measured, side_a);
}

TEST(WholeValve, TakesTheFlowFromPortPressuresWhereALoadDrivesTheOilBack) {
  const Sides sides;
  for (const bool side_a : {false, true}) {
    WholeValveState<double> state = opened(sides, side_a);
    WholeValveSample<double> sample = held_open(sides, side_a);
    // The load holds 20 bar more than the supply in the chamber that is fed, and 20 bar less than the tank's line
    // gives.
    const double fed_Pa = 70e5, other_Pa = 5e5;
    sample.ports = {50e5, side_a ? fed_Pa : other_Pa, side_a ? other_Pa : fed_Pa, 25e5};
    const Estimate<double> answer = step(sides.whole, state, sample);
    const double conductance = sides.b.edge.at(sample.oil_temperature_K, 40e5, 1.5e-3).conductance;
    const double expected = (side_a ? 1 : -1) * conductance * std::sqrt(40e5);
    EXPECT_NEAR(answer.flow_m3_per_s, expected, 0.02 * std::abs(expected));
    EXPECT_LT(answer.flow_lower_m3_per_s, expected);
    EXPECT_GT(answer.flow_upper_m3_per_s, expected);
    EXPECT_TRUE(has(answer.status, Status::flow_reversed));
    EXPECT_FALSE(has(answer.status, Status::ambiguous_load));
  }
}

TEST(WholeValve, AnswersByPortPressuresWhatItKnowsByForcesToo) {
  const Sides sides;
  WholeValveState<double> by_forces = opened(sides, false), by_pressures = by_forces;
  WholeValveSample<double> sample = held_open(sides, false);
  const Estimate<double> without = step(sides.whole, by_forces, sample);
  sample.ports = {70e5, 31e5, 40e5, 1e5};
  const Estimate<double> with = step(sides.whole, by_pressures, sample);
  EXPECT_NEAR(with.flow_m3_per_s, without.flow_m3_per_s, 0.1 * without.flow_m3_per_s);
  EXPECT_LT(with.flow_upper_m3_per_s - with.flow_lower_m3_per_s, 0.2 * with.flow_m3_per_s);
  EXPECT_FALSE(has(with.status, Status::flow_reversed));
}

TEST(WholeValve, FindsHowTheEdgesShareThePressureDrop) {
  const Sides sides;
  WholeValveState<double> state = opened(sides, false);
  WholeValveSample<double> sample = held_open(sides, false);
  sample.ports = {70e5, 41e5, 50e5, 1e5};  // the inlet takes a third of 60 bar
  Estimate<double> answer{};
  for (int k = 0; k < 10000; ++k) answer = step(sides.whole, state, sample);
  const double conductance = sides.b.edge.at(sample.oil_temperature_K, 60e5, 1.5e-3).conductance;
  EXPECT_NEAR(answer.flow_m3_per_s, conductance * std::sqrt(60e5), 0.02 * conductance * std::sqrt(60e5));
}

TEST(WholeValve, WhoseEdgesAreCalibratedGivesTheInletsFlowUnderAnyLoad) {
  Sides sides;
  sides.b.inlet = {.share = 0.6, .range = 0.02};
  WholeValveState<double> state = opened(sides, false);
  WholeValveSample<double> sample = held_open(sides, false);
  const double expected = sides.b.edge.at(sample.oil_temperature_K, 40e5, 1.5e-3).conductance * std::sqrt(40e5);
  for (const double outlet_Pa : {2e5, 16e5, 24e5, 60e5}) {
    sample.ports = {70e5, outlet_Pa + 1e5, 46e5, 1e5};  // 24 bar over the inlet
    Estimate<double> answer{};
    for (int k = 0; k < 1000; ++k) answer = step(sides.whole, state, sample);
    EXPECT_NEAR(answer.flow_m3_per_s, expected, 0.02 * expected) << outlet_Pa;
  }
}

TEST(WholeValve, NeedsThePressuresOfAllFourPorts) {
  const Sides sides;
  WholeValveState<double> none = opened(sides, true), three = none;
  WholeValveSample<double> sample = held_open(sides, true);
  const Estimate<double> without = step(sides.whole, none, sample);
  sample.ports.p_Pa = sample.ports.a_Pa = sample.ports.b_Pa = 20e5;
  const Estimate<double> with = step(sides.whole, three, sample);
  EXPECT_EQ(with.flow_m3_per_s, without.flow_m3_per_s);
  EXPECT_EQ(with.flow_lower_m3_per_s, without.flow_lower_m3_per_s);
}

TEST(WholeValve, SaysWhereMoreForceActsThanTheSupplyExplains) {
  const Sides sides;
  const double calibrated_Pa = sides.b.edge.highest_pressure_difference_Pa();
  const Course course =
      Course({.position_m = 0.05e-3, .pressure_difference_Pa = 1.3 * calibrated_Pa}).slide(1.5e-3, 1.5);
  WholeValveState<double> state{};
  for (const ValveSample& sample : run_of(sides.law, course)) step(sides.whole, state, to_side(sample.measured, false));
  EXPECT_TRUE(has(state.open.last.status, Status::ambiguous_load));
  EXPECT_FALSE(has(opened(sides, false).open.last.status, Status::ambiguous_load));
}

/// The end of a stroke to b, with `spike_A` on the other coil in every fiftieth sample.
struct IdleSpikes {
  double opposing_N = 0;
  int faults = 0;
};
IdleSpikes with_idle_spikes(const CurrentLimits<double>& limits, double spike_A) {
  Sides sides{.law = closed_form};
  sides.a.current_limits = sides.b.current_limits = limits;
  WholeValveState<double> state{};
  IdleSpikes out;
  int k = 0;
  for (const ValveSample& sample : run_of(sides.law, out_and_back(60e5))) {
    WholeValveSample<double> measured = to_side(sample.measured, false);
    if (++k % 50 == 0) measured.current_a_A = spike_A;
    out.faults += has(step(sides.whole, state, measured).status, Status::current_fault) ? 1 : 0;
    out.opposing_N = std::max(out.opposing_N, state.idle.magnetic_force_N);
  }
  return out;
}

TEST(WholeValve, TakesALeapOfTheIdleCoilsCurrentForAFaultOfItsMeasurement) {
  const CurrentLimits<double> limits{0.2, 490};
  EXPECT_EQ(with_idle_spikes(limits, 0).faults, 0);
  const IdleSpikes guarded = with_idle_spikes(limits, 2.0);
  EXPECT_GT(guarded.faults, 20);
  EXPECT_EQ(guarded.opposing_N, with_idle_spikes(limits, 0).opposing_N);
  EXPECT_GT(with_idle_spikes({}, 2.0).opposing_N, guarded.opposing_N + 0.5);
}

}  // namespace
}  // namespace spoolflow::sensor
