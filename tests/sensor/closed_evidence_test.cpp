/// A position that stays closed while the forces would move any spool.
#include "spoolflow/sensor/closed_evidence.hpp"

#include <gtest/gtest.h>

#include "spoolflow/sensor/whole_valve/whole_valve.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

constexpr double tick_s = 1e-3;
const ClosedFormValve ironless{.iron = 0};

/// Opens to 2.2 mm, rests and closes, at 60 bar.
std::vector<ValveSample> stroke() {
  Course course({.position_m = 0.02e-3, .pressure_difference_Pa = 60e5});
  course.rest(0.3, 1).slide(2.2e-3, 2).rest(0.5, -1).slide(0.02e-3, 2).rest(0.2, -1);
  return ClosedFormRun(ironless, course).sampled(course.end_s(), tick_s);
}

/// What a dead line leaves of the position.
double dead_m(std::size_t sample) {
  return sample % 3 == 0 ? 1e-6 : -0.5e-6;
}

TEST(ClosedEvidence, OpensTheBandWhereTheForcesContradictAPositionThatIsDeadAtZero) {
  const ObserverParameters<double> valve = closed_form_observer<double>(ironless);
  ObserverState<double> state{};
  Judgement doubted;
  std::size_t sample = 0;
  int silent = 0;
  for (const ValveSample& now : stroke()) {
    Sample<double> measured = now.measured;
    measured.position_m = dead_m(sample++);
    const Estimate<double>& answer = step(valve, state, measured);
    const double opening = now.flow_m3_per_s / ironless.full_scale_m3_per_s();
    silent += opening > 0.4 && !has(answer.status, Status::position_fault) ? 1 : 0;
    if (has(answer.status, Status::position_fault))
      doubted.add(answer, now.flow_m3_per_s, ironless.full_scale_m3_per_s());
  }
  EXPECT_GT(doubted.samples, 2000);
  EXPECT_GT(doubted.coverage(), 0.99);
  EXPECT_LE(silent, 1) << "one sample looks again after each 2.5 s";
  for (; sample < 10000; ++sample) step(valve, state, {tick_s, 0.0, 0.0, dead_m(sample), 313.0});
  EXPECT_EQ(state.last.status, Status::closed | Status::spool_at_rest) << "the spring has closed the valve";
}

TEST(ClosedEvidence, OfAWholeValveOpensTheBandToTheSideToWhichTheStrongerSolenoidPulls) {
  const ObserverParameters<double> direction = closed_form_observer<double>(ironless);
  const WholeValveParameters<double> valve{&direction, &direction};
  for (const bool side_a : {false, true}) {
    WholeValveState<double> state{};
    Judgement doubted;
    std::size_t sample = 0;
    for (const ValveSample& now : stroke()) {
      const auto& [step_s, current_A, voltage_V, position_m, oil_K] = now.measured;
      const double dead = dead_m(sample++);
      const WholeValveSample<double> measured =
          side_a ? WholeValveSample<double>{step_s, current_A, 0, voltage_V, 0, dead, oil_K}
                 : WholeValveSample<double>{step_s, 0, current_A, 0, voltage_V, dead, oil_K};
      const Estimate<double>& answer = step(valve, state, measured);
      if (has(answer.status, Status::position_fault))
        doubted.add(answer, side_a ? -now.flow_m3_per_s : now.flow_m3_per_s, ironless.full_scale_m3_per_s());
    }
    EXPECT_GT(doubted.samples, 2000) << side_a;
    EXPECT_GT(doubted.coverage(), 0.99) << side_a;
  }
}

TEST(ClosedEvidence, TakesASpoolThatSticksTwiceAsHardAsCalibratedForWhatItIs) {
  const ObserverParameters<double> valve = closed_form_observer<double>(ironless);
  ObserverState<double> state{};
  const double friction_N = ironless.ageing_ratio * ironless.spool_friction_N(0.275 * ironless.highest_Pa, 313);
  const double current_A = (ironless.spring_N(0) + 2 * friction_N + 0.6) / ironless.force_per_current_N_per_A(0);
  for (std::size_t sample = 0; sample < 5000; ++sample) {
    const Estimate<double> answer = step(valve, state, {tick_s, current_A, 10 * current_A, dead_m(sample), 313.0});
    ASSERT_FALSE(has(answer.status, Status::position_fault)) << sample;
  }
}

TEST(ClosedEvidence, GivesASpoolTimeToBreakAway) {
  const ObserverParameters<double> valve = closed_form_observer<double>(ironless);
  ObserverState<double> state{};
  for (std::size_t sample = 0; sample < 1000; ++sample) step(valve, state, {tick_s, 0.0, 0.0, dead_m(sample), 313.0});
  int doubted = 0;
  for (std::size_t sample = 0; sample < 60; ++sample)
    doubted += has(step(valve, state, {tick_s, 1.5, 15.0, dead_m(sample), 313.0}).status, Status::position_fault);
  EXPECT_GT(doubted, 0);
  EXPECT_LE(doubted, 60 - static_cast<int>(longest_unmoved_s / tick_s));
}

}  // namespace
}  // namespace spoolflow::sensor
