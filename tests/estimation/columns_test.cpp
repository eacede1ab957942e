/// What both sensors answer to columns: of one valve in closed form for the observer, of a straight one for the
/// condensed sensor, whose tables cannot hold the other exactly.
#include "spoolflow/estimation/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "tests/sensor/linear_valve.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::estimation {
namespace {

using sensor::Status;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// 20 N/A, 10 N/mm of spring, flow 1e-3 m3/s times the root of the flow force's share of 50 N.
model::Model linear_model() {
  model::Model model{};
  model.valve = {"linear valve", 1e-3, 2.4e-3, "b"};
  model.condensed.parameters = sensor::linear_valve();
  return model;
}

/// Columns, and the flow that there was.
struct Measured {
  std::vector<double> time_s, current_A, voltage_V, position_m, oil_temperature_K, flow_m3_per_s;

  void add(const TimedSample& sample, double truth_m3_per_s) {
    time_s.push_back(sample.time_s);
    current_A.push_back(sample.current_A);
    voltage_V.push_back(sample.voltage_V);
    position_m.push_back(sample.position_m);
    oil_temperature_K.push_back(sample.oil_temperature_K);
    flow_m3_per_s.push_back(truth_m3_per_s);
  }
  [[nodiscard]] std::size_t size() const { return time_s.size(); }
  [[nodiscard]] Columns columns(std::size_t first, std::size_t count) const {
    const auto part = [&](const std::vector<double>& values) { return std::span(values).subspan(first, count); };
    return {part(time_s), part(current_A), part(voltage_V), part(position_m), part(oil_temperature_K)};
  }
};

using Estimates = std::vector<sensor::Estimate<double>>;

Estimates answers(RunningSensor& sensor, const Columns& columns) {
  Estimates out(columns.size());
  run(sensor, columns, out);
  return out;
}
Estimates answers(RunningSensor& sensor, const Measured& run) {
  return answers(sensor, run.columns(0, run.size()));
}

class Sensors : public testing::TestWithParam<Estimator> {
 protected:
  Sensors() {
    if (observer()) {
      model_.valve = {"closed form", valve_.full_scale_m3_per_s(), sensor::ClosedFormValve::stroke_m, "b"};
      model_.observer.emplace().parameters = sensor::closed_form_observer<double>(valve_);
    }
  }

  [[nodiscard]] static bool observer() { return GetParam() == Estimator::observer; }
  [[nodiscard]] RunningSensor new_sensor() const { return running_sensor(model_, GetParam()); }
  [[nodiscard]] double full_scale_m3_per_s() const { return model_.valve.rated_flow_m3_per_s; }

  /// Two strokes in 7 s, from `start_s` on.
  [[nodiscard]] Measured strokes(double start_s) const {
    constexpr double sample_s = 1e-3;
    sensor::Course course({.position_m = 0.5e-3, .pressure_difference_Pa = 40e5});
    course.slide(2e-3, 1.5)
        .rest(0.3, -1)
        .slide(0.8e-3, 1.5)
        .rest(0.3, 1)
        .slide(1.8e-3, 1.5)
        .rest(0.3, -1)
        .slide(1e-3, 1.5);
    Measured out;
    double time_s = start_s;
    for (const sensor::ValveSample& sample : sensor::ClosedFormRun(valve_, course).sampled(course.end_s(), sample_s)) {
      const sensor::Sample<double>& measured = sample.measured;
      TimedSample seen{time_s += sample_s, measured.current_A, measured.voltage_V, measured.position_m,
                       measured.oil_temperature_K};
      double truth_m3_per_s = sample.flow_m3_per_s;
      if (!observer()) {  // 5 to 35 N of flow force
        const double flow_force_N = 20 + 15 * std::sin(2 * time_s);
        seen.current_A = (1e4 * seen.position_m + flow_force_N) / 20;
        truth_m3_per_s = 1e-3 * std::sqrt(flow_force_N / 50);
      }
      out.add(seen, truth_m3_per_s);
    }
    return out;
  }

  sensor::ClosedFormValve valve_;
  model::Model model_ = linear_model();
};
INSTANTIATE_TEST_SUITE_P(Both, Sensors, testing::Values(Estimator::condensed, Estimator::observer),
                         [](const auto& of) { return std::string(name(of.param)); });

TEST_P(Sensors, AnswerEverySampleOnceHoweverTheColumnsAreCut) {
  const Measured run = strokes(3);
  RunningSensor at_once = new_sensor();
  RunningSensor in_pieces = new_sensor();
  const Estimates expected = answers(at_once, run);
  Estimates cut;
  for (std::size_t first = 0, length = 1; first < run.size(); first += length, length = length * 3 % 1009 + 1) {
    length = std::min(length, run.size() - first);
    const Estimates piece = answers(in_pieces, run.columns(first, length));
    cut.insert(cut.end(), piece.begin(), piece.end());
  }
  ASSERT_EQ(cut.size(), run.size());
  sensor::Judgement judged;
  for (std::size_t k = 0; k < run.size(); ++k) {
    ASSERT_EQ(cut[k].flow_m3_per_s, expected[k].flow_m3_per_s) << k;
    ASSERT_EQ(cut[k].flow_upper_m3_per_s, expected[k].flow_upper_m3_per_s) << k;
    if (run.time_s[k] > 4.5) judged.add(cut[k], run.flow_m3_per_s[k], full_scale_m3_per_s());
  }
  // The tables hold both valves exactly. Left over is what noise does to the observer, and the history of the iron,
  // which it does not know: these strokes do not wipe it out.
  EXPECT_LT(judged.rms(), observer() ? 1.5e-3 : 1e-9);
  EXPECT_LT(judged.largest, observer() ? 7e-3 : 1e-9);
}

TEST_P(Sensors, AnswerZeroWithTheWholeRangeAsBandBeforeTheFirstCompleteSample) {
  RunningSensor sensor = new_sensor();
  Measured run;
  run.add({0, missing, missing, 1e-3, missing}, 0);
  run.add({1e-3, 1.5, missing, missing, missing}, 0);
  run.add({2e-3, 1.5, missing, 1e-3, missing}, 0);
  const Estimates out = answers(sensor, run);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_EQ(out[k].flow_m3_per_s, 0);
    EXPECT_EQ(out[k].flow_lower_m3_per_s, 0);
    EXPECT_EQ(out[k].flow_upper_m3_per_s, full_scale_m3_per_s());
    EXPECT_TRUE(has(out[k].status, Status::sample_missing));
  }
  EXPECT_GT(out[2].flow_m3_per_s, 0);
  EXPECT_FALSE(has(out[2].status, Status::sample_missing));
}

TEST_P(Sensors, HoldTheirAnswerOverMissingSamplesAndAcrossColumns) {
  RunningSensor sensor = new_sensor();
  const Measured run = strokes(0);
  const sensor::Estimate<double> before = answers(sensor, run).back();
  Measured without;
  without.add({run.time_s.back() + 1e-3, missing, 0, 1e-3, 313}, 0);
  without.add({run.time_s.back() + 2e-3, missing, missing, missing, missing}, 0);
  without.add({run.time_s.back() + 3e-3, 1, 10, missing, 313}, 0);
  for (const auto& held : answers(sensor, without)) {
    EXPECT_EQ(held.flow_m3_per_s, before.flow_m3_per_s);
    EXPECT_LE(held.flow_lower_m3_per_s, before.flow_lower_m3_per_s);
    EXPECT_GE(held.flow_upper_m3_per_s, before.flow_upper_m3_per_s);
    EXPECT_TRUE(has(held.status, Status::sample_missing));
  }
}

/// Four thousand samples at random times, anything missing, anything far outside what the valve can do.
Measured nonsense() {
  std::mt19937 random(3);
  const auto one_of = [&](std::initializer_list<double> values) { return values.begin()[random() % values.size()]; };
  const auto part = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()); };
  Measured out;
  double time_s = 0;
  for (int k = 0; k < 4000; ++k) {
    time_s += one_of({1e-3, 1e-3, 1e-3, 5e-5, 0.0, 0.7, 3600.0, -0.5});
    out.add({random() % 50 == 0 ? missing : time_s, one_of({missing, 2.5 * part(), 2.5 * part(), -1.0, 0.0, 40.0, 1e9}),
             one_of({missing, 25 * part(), -25 * part(), 1e4}),
             one_of({missing, 2.4e-3 * part(), 2.4e-3 * part(), -1e-3, 0.0, 1.0}),
             one_of({missing, 313.0, 300 + 50 * part(), 0.0, 1e4})},
            0);
  }
  return out;
}

TEST_P(Sensors, NeverAnswerNaNAndFindTheFlowAgainAfterNonsense) {
  RunningSensor sensor = new_sensor();
  const Measured bad = nonsense();
  const Estimates out = answers(sensor, bad);
  std::size_t held = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    ASSERT_TRUE(std::isfinite(out[k].flow_m3_per_s)) << k;
    ASSERT_TRUE(std::isfinite(out[k].pressure_difference_Pa)) << k;
    ASSERT_TRUE(std::isfinite(out[k].friction_force_N)) << k;
    ASSERT_LE(out[k].flow_lower_m3_per_s, out[k].flow_m3_per_s) << k;
    ASSERT_LE(out[k].flow_m3_per_s, out[k].flow_upper_m3_per_s) << k;
    held += has(out[k].status, Status::sample_missing) || has(out[k].status, Status::time_fault) ? 1 : 0;
  }
  EXPECT_LT(held, out.size() * 4 / 5) << "the rest was computed";
  const Measured good = strokes(1e8);
  const Estimates after = answers(sensor, good);
  sensor::Judgement judged;
  for (std::size_t k = 3500; k < good.size(); ++k) judged.add(after[k], good.flow_m3_per_s[k], full_scale_m3_per_s());
  // The observer still forgets the oil of 10 000 K and the friction that it was given.
  EXPECT_LT(judged.largest, observer() ? 0.025 : 1e-9);
}

TEST_P(Sensors, ReportACoilOfTwiceItsResistanceWhereTheVoltageIsMeasured) {
  Measured run = strokes(0);
  for (double& voltage_V : run.voltage_V) voltage_V *= 2;
  RunningSensor measured = new_sensor();
  EXPECT_EQ(has(answers(measured, run).back().status, Status::coil_fault), observer());
  RunningSensor not_measured = new_sensor();
  Columns columns = run.columns(0, run.size());
  columns.voltage_V = {};
  EXPECT_FALSE(has(answers(not_measured, columns).back().status, Status::coil_fault));
}

TEST(Estimator, AskedForAnObserverThatTheModelLacksSaysWhatToDo) {
  const model::Model model = linear_model();
  EXPECT_THAT([&] { (void)running_sensor(model, Estimator::observer); },
              ::testing::ThrowsMessage<model::ModelError>(
                  ::testing::AllOf(::testing::HasSubstr("linear valve"), ::testing::HasSubstr("calibrate"))));
  EXPECT_EQ(best_estimator(model), Estimator::condensed);
}

}  // namespace
}  // namespace spoolflow::estimation
