/// The observer of a valve in closed form against the truth: error and coverage in each thing that a spool does, at
/// every sampling rate.
#include "spoolflow/sensor/observer.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

/// The observer over a run; what `meddle` does to a sample is what its electronics get wrong.
template <class Each, class Meddle>
void observe(const std::vector<ValveSample>& run, const Meddle& meddle, const Each& each,
             const ObserverParameters<double>& parameters = closed_form_observer<double>(closed_form)) {
  ObserverState<double> state{};
  double time_s = 0;
  for (const ValveSample& sample : run) {
    Sample<double> measured = sample.measured;
    time_s += measured.time_step_s;
    meddle(time_s, measured);
    const Estimate<double>& answer = step(parameters, state, measured);
    each(time_s, sample, answer, state);
  }
}

struct Between {
  double from_s, to_s;
};

Judgement judge(const std::vector<ValveSample>& run, Between times) {
  Judgement out;
  observe(
      run, [](double, Sample<double>&) {},
      [&](double time_s, const ValveSample& sample, const Estimate<double>& answer, const auto&) {
        if (time_s > times.from_s && time_s < times.to_s)
          out.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
      });
  return out;
}

class Observer : public testing::TestWithParam<double> {
 protected:
  [[nodiscard]] static double step_s() { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(SampledEvery, Observer, testing::Values(50e-6, 200e-6, 1e-3, 5e-3),
                         [](const auto& rate) { return std::to_string(static_cast<int>(1e6 * rate.param)) + "us"; });

/// Slides from 0.4 mm to 2.2 mm in two seconds: the first half second finds the pressure.
Course opening(double pressure_Pa = 60e5) {
  return Course({.position_m = 0.4e-3, .pressure_difference_Pa = pressure_Pa}).rest(0.1, 1).slide(2.2e-3, 2);
}

TEST_P(Observer, KnowsTheFlowToHalfAPercentWhileTheSpoolSlides) {
  for (const double pressure_Pa : {20e5, 60e5, 85e5}) {
    Course course = opening(pressure_Pa).rest(0.2, -1).slide(0.6e-3, 1.8);
    const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
    for (const Between& slides : {Between{0.8, 2.1}, Between{2.45, 4.0}}) {
      const Judgement sliding = judge(run, slides);
      EXPECT_LT(sliding.largest, 0.01) << pressure_Pa;
      EXPECT_LT(sliding.rms(), 0.005) << pressure_Pa;
      EXPECT_GT(sliding.coverage(), 0.95) << pressure_Pa;
      EXPECT_LT(sliding.mean_width(), 0.06) << pressure_Pa;
    }
  }
}

TEST_P(Observer, FollowsAPressureThatChangesWhileTheSpoolSlides) {
  Course course = opening().slide(1.5e-3, 0.5).slide(0.6e-3, 0.6, 40e5).slide(1.8e-3, 1.2);
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
  const Judgement settled = judge(run, {3.6, course.end_s()});
  EXPECT_LT(settled.largest, 0.01);
  EXPECT_GT(settled.coverage(), 0.95);
}

TEST_P(Observer, HoldsTheFlowAtRestAndItsBandHoldsWhatTheSupplyDidUnseen) {
  // Friction takes up what 4 bar more of pressure ask for: 60 to 64 bar is 1.8 N, of the 7 N between its limits.
  Course course = opening().rest(0.3, 0.8).rest(0.4, 0.4, 64e5).rest(0.5, 0.4);
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
  const Judgement before = judge(run, {2.2, 2.4});
  EXPECT_LT(before.largest, 0.04);  // the end of sliding is taken for sliding for some milliseconds
  const Judgement resting = judge(run, {2.2, course.end_s()});
  EXPECT_GT(resting.coverage(), 0.95);
  EXPECT_LT(resting.largest, 0.05);
  EXPECT_LT(resting.mean_width(), 0.25);  // friction's limits allow 0.3
}

TEST_P(Observer, OnTheOpenStopItsBandHoldsASupplyThatFallsUnseenAndOffItTheFlowIsFoundAgain) {
  // The stop holds what the magnetic force has beyond friction: several times friction's limit.
  Course course = opening();
  const double arrives_s = course.end_s();
  course.rest(0.2, 4).rest(0.4, 9, 15e5).rest(0.5, 9).rest(0.2, -1);
  const double leaves_s = course.end_s();
  course.slide(0.8e-3, 1.4);
  ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  valve.stopped_above_m = 2.19e-3;
  Judgement on_stop, off_stop;
  int marked = 0;
  observe(
      ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s()), [](double, Sample<double>&) {},
      [&](double time_s, const ValveSample& sample, const Estimate<double>& answer, const auto&) {
        const bool on = time_s > arrives_s + 0.05 && time_s < leaves_s - 0.1;
        if (on) on_stop.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
        if (on && has(answer.status, Status::open_stop)) ++marked;
        if (time_s > leaves_s + 0.5) {
          off_stop.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
          EXPECT_FALSE(has(answer.status, Status::open_stop));
        }
      },
      valve);
  EXPECT_EQ(marked, on_stop.samples);
  EXPECT_EQ(on_stop.inside, on_stop.samples);
  EXPECT_LT(off_stop.rms(), 0.01);
  EXPECT_GT(off_stop.coverage(), 0.95);
}

TEST_P(Observer, FindsThePressureAgainWhenTheSpoolBreaksAway) {
  Course course = opening().rest(0.4, 0.2).rest(0.6, 0.2, 70e5).rest(0.4, 1.15).slide(2.35e-3, 0.4);
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
  const Judgement resting = judge(run, {3.0, 3.1});
  const Judgement sliding = judge(run, {3.7, course.end_s()});
  EXPECT_LT(sliding.largest, 0.02);
  EXPECT_LT(sliding.rms(), 0.5 * resting.rms() + 0.003);
  EXPECT_GT(sliding.coverage(), 0.95);
}

TEST_P(Observer, HoldsTheFlowThroughStickAndSlip) {
  Course course = opening().slide(0.8e-3, 1.2);
  for (int k = 0; k < 12; ++k) course.rest(0.15, 1.1).slip(course.last().position_m + 0.06e-3, 6e-3);
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
  const Judgement slipping = judge(run, {3.6, course.end_s()});
  EXPECT_LT(slipping.rms(), 0.02);
  EXPECT_GT(slipping.coverage(), 0.93);
}

TEST_P(Observer, TakesAJumpOfThePositionSignalForAFaultAndGoesOn) {
  const Course course = opening();
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
  Judgement faulty;
  int reported = 0, jumped = 0;
  observe(
      run,
      [](double time_s, Sample<double>& measured) {
        if (time_s > 1.2 && time_s < 1.23) measured.position_m += 0.3e-3;
      },
      [&](double time_s, const ValveSample& sample, const Estimate<double>& answer, const auto&) {
        if (time_s > 0.8) faulty.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
        const bool jumps = time_s > 1.2 && time_s < 1.23;
        jumped += jumps ? 1 : 0;
        reported += jumps && has(answer.status, Status::position_fault) ? 1 : 0;
      });
  // At 5 ms the hardest acceleration allows 2.3 mm a sample: nothing can be separated from motion.
  if (step_s() < 2e-3) {
    EXPECT_EQ(reported, jumped);
    EXPECT_LT(faulty.largest, 0.012);
  }
  EXPECT_GT(faulty.coverage(), 0.95);
}

TEST_P(Observer, NeedsNeitherVoltageNorOilTemperature) {
  const Course course = opening();
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), step_s());
  Judgement without;
  observe(
      run, [](double, Sample<double>& measured) { measured.voltage_V = measured.oil_temperature_K = NAN; },
      [&](double time_s, const ValveSample& sample, const Estimate<double>& answer, const auto&) {
        if (time_s > 0.8) without.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
      });
  EXPECT_LT(without.largest, 0.05);  // the map's middle temperature stands for the oil's: 2 % of conductance a layer
}

TEST_P(Observer, FindsFrictionThatDiffersFromTheBench) {
  Course course = opening();
  for (int k = 0; k < 12; ++k) course.rest(0.1, -1).slide(0.8e-3, 0.7).rest(0.1, 1).slide(2.0e-3, 0.7);
  const auto run = ClosedFormRun(closed_form, course, {.friction_ratio = 0.9}).sampled(course.end_s(), step_s());
  double ratio = 0;
  Judgement last;
  observe(
      run, [](double, Sample<double>&) {},
      [&](double time_s, const ValveSample& sample, const Estimate<double>& answer, const auto& state) {
        ratio = state.pressure.friction_ratio;
        if (time_s > course.end_s() - 0.6) last.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
      });
  EXPECT_NEAR(ratio, 0.9, step_s() > 2e-3 ? 0.07 : 0.04);  // a quarter of the blocks in which motion is found
  EXPECT_LT(last.largest, 0.012);
}

TEST(Observer, FindsAShortedCoilByItsResistance) {
  const Course course = opening();
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), 1e-3);
  Status last{};
  observe(
      run, [](double, Sample<double>& measured) { measured.voltage_V *= 0.4; },
      [&](double, const ValveSample&, const Estimate<double>& answer, const auto&) { last = answer.status; });
  EXPECT_TRUE(has(last, Status::coil_fault));
}

/// Both kinds of number: the firmware's and the host's.
template <class T>
void leap(T step_s) {
  const ObserverParameters<T> valve = closed_form_observer<T>(closed_form);
  ObserverState<T> state{};
  Sample<T> sample{T(1e-3), T(1.2), T(10), T(1e-3), T(313)};
  for (int k = 0; k < 2000; ++k) {
    sample.position_m = T(1e-3) + T(0.4e-3) * std::sin(T(0.01) * T(k));
    step(valve, state, sample);
  }
  const Estimate<T> before = state.last;
  sample.time_step_s = step_s;
  const Estimate<T> after = step(valve, state, sample);
  EXPECT_TRUE(has(after.status, Status::time_fault)) << step_s;
  EXPECT_GT(after.flow_upper_m3_per_s - after.flow_lower_m3_per_s,
            T(1.5) * (before.flow_upper_m3_per_s - before.flow_lower_m3_per_s));
  sample.time_step_s = T(1e-3);
  for (int k = 0; k < 2000; ++k) {
    const Estimate<T> answer = step(valve, state, sample);
    ASSERT_FALSE(has(answer.status, Status::time_fault));
    ASSERT_TRUE(std::isfinite(answer.flow_m3_per_s));
    ASSERT_LT(answer.flow_lower_m3_per_s, answer.flow_upper_m3_per_s);
  }
}

TEST(Observer, IsResetAndReportsItWhereTimeLeaps) {
  // 4 294 967 s: a counter of milliseconds in 32 bits that ran back by a tick.
  for (const double step_s : {1.5, 100.0, 2e6, 4294967.296, 1e9}) {
    leap<float>(static_cast<float>(step_s));
    leap<double>(step_s);
  }
}

TEST(Observer, ReportsATimeThatStandsStill) {
  const ObserverParameters<float> valve = closed_form_observer<float>(closed_form);
  ObserverState<float> state{};
  const auto take = [&](float time_step_s) { return step(valve, state, {time_step_s, 1.2F, 10, 1e-3F, 313}).status; };
  EXPECT_FALSE(has(take(0), Status::time_fault)) << "before the first sample no time has passed";
  EXPECT_FALSE(has(take(1e-3F), Status::time_fault));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(has(take(0), Status::time_fault));
  EXPECT_FALSE(has(take(1e-3F), Status::time_fault));
}

template <class T>
void stall(T step_s) {
  const ObserverParameters<T> valve = closed_form_observer<T>(closed_form);
  ObserverState<T> state{};
  const auto take = [&](T time_step_s) { return step(valve, state, Sample<T>{time_step_s, 1.2F, 10, 1e-3F, 313}); };
  for (int k = 0; k < 1000; ++k) ASSERT_FALSE(has(take(T(1e-3)).status, Status::time_fault));
  const Estimate<T> answer = take(step_s);
  EXPECT_TRUE(has(answer.status, Status::time_fault)) << step_s;
  EXPECT_LE(answer.flow_lower_m3_per_s, answer.flow_m3_per_s);
  EXPECT_FALSE(has(take(T(5e-3)).status, Status::time_fault));
}

TEST(Observer, SaysSoWhereTheTimeStepIsLongerThanItIsMadeFor) {
  for (const double step_s : {10e-3, 20e-3, 50e-3, 0.2, 1.0}) {  // 1: a step of 1 ms given as seconds
    stall<float>(static_cast<float>(step_s));
    stall<double>(step_s);
  }
}

/// The answer after a second at rest whose oil temperature reads `read_K` from its middle on, for `samples`.
Estimate<double> with_oil_reading(double read_K, int samples) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  for (int k = 0; k < 1000; ++k) {
    const bool broken = k >= 500 && k < 500 + samples;
    step(valve, state, {1e-3, 1.2, 10, 1e-3 + 1e-7 * k, broken ? read_K : 313.0});
  }
  return state.last;
}

TEST(Observer, HoldsTheOilTemperatureWhereItsSensorIsBroken) {
  const Estimate<double> sound = with_oil_reading(313.0, 500);
  for (const double read_K : {223.15, 73.15, 1123.15, 1e5, 350.0}) {
    const Estimate<double> broken = with_oil_reading(read_K, 500), once = with_oil_reading(read_K, 1);
    EXPECT_TRUE(has(broken.status, Status::temperature_fault)) << read_K;
    EXPECT_FALSE(has(once.status, Status::temperature_fault)) << read_K;
    EXPECT_EQ(broken.flow_m3_per_s, sound.flow_m3_per_s) << read_K;
    EXPECT_EQ(once.flow_m3_per_s, sound.flow_m3_per_s) << read_K;
  }
  EXPECT_FALSE(has(sound.status, Status::temperature_fault));
}

/// The first plausible temperature comes after `late` samples that read `before_K`.
ObserverState<double> with_late_oil_reading(double before_K, int late) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  for (int k = 0; k < late + 20; ++k) step(valve, state, {1e-3, 1.2, 10, 1e-3, k < late ? before_K : 333.0});
  return state;
}

TEST(Observer, TakesTheFirstTemperatureOfTheOilAtOnceHoweverLateItComes) {
  for (const double before_K : {static_cast<double>(NAN), 73.15}) {
    for (const int late : {1, 700}) {
      const ObserverState<double> state = with_late_oil_reading(before_K, late);
      EXPECT_EQ(state.oil.temperature_K, 333.0) << before_K << " " << late;
      EXPECT_FALSE(has(state.last.status, Status::temperature_fault)) << before_K << " " << late;
    }
  }
}

TEST(Observer, MarksABrokenOilTemperatureFromTheFirstSampleOn) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  for (int k = 0; k < 50; ++k) {
    step(valve, state, {1e-3, 1.2, 10, 1e-3, 73.15});
    EXPECT_TRUE(has(state.last.status, Status::temperature_fault)) << k;
  }
}

TEST(Observer, BelievesALeapOfTheOilTemperatureThatLasts) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  for (int k = 0; k < 25000; ++k) step(valve, state, {1e-3, 1.2, 10, 1e-3, k < 1000 ? 303.0 : 333.0});
  EXPECT_NEAR(state.oil.temperature_K, 333.0, 0.1);
  EXPECT_FALSE(has(state.last.status, Status::temperature_fault));
}

TEST(Observer, HoldsItsAnswerWhereCurrentOrPositionIsMissingOrTimeRunsBackwards) {
  const Course course = opening();
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), 1e-3);
  double before = 0;
  observe(
      run,
      [](double time_s, Sample<double>& measured) {
        if (time_s > 1.0 && time_s < 1.01) measured.current_A = NAN;
        if (time_s > 1.1 && time_s < 1.11) measured.position_m = INFINITY;
        if (time_s > 1.2 && time_s < 1.21) measured.time_step_s = -1e-3;
      },
      [&](double time_s, const ValveSample&, const Estimate<double>& answer, const auto&) {
        const bool missing = (time_s > 1.0 && time_s < 1.01) || (time_s > 1.1 && time_s < 1.11);
        const bool backwards = time_s > 1.2 && time_s < 1.21;
        EXPECT_EQ(has(answer.status, Status::sample_missing), missing) << time_s;
        EXPECT_EQ(has(answer.status, Status::time_fault), backwards) << time_s;
        if (missing || backwards) {
          EXPECT_EQ(answer.flow_m3_per_s, before);
        }
        before = answer.flow_m3_per_s;
      });
}

}  // namespace
}  // namespace spoolflow::sensor
