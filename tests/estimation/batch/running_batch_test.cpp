/// Runs of unequal length and sampling rate in a batch against the same runs through sensors of their own.
#include "spoolflow/estimation/batch/running_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sensor/valve_course.hpp"

namespace spoolflow::estimation::batch {
namespace {

using Observer = sensor::ObserverParameters<float>;
using Answers = std::vector<sensor::Estimate<float>>;

/// What one valve measures, in columns.
struct MeasuredRun {
  std::vector<double> time_s, current_A, voltage_V, position_m, oil_temperature_K;

  [[nodiscard]] Columns from(std::size_t begin, std::size_t end) const {
    const auto of = [&](const std::vector<double>& column) { return std::span(column).subspan(begin, end - begin); };
    return {of(time_s), of(current_A), of(voltage_V), of(position_m), of(oil_temperature_K)};
  }
  [[nodiscard]] Columns all() const { return from(0, time_s.size()); }
};

sensor::ClosedFormValve valve_number(std::size_t k) {
  return {.scale = 1 + 0.03 * static_cast<double>(k)};
}

/// Slides and rests; valve `k` at its own pace, for its own time, every so many milliseconds. Its time stamps begin
/// anywhere, and some of it is missing or repeated.
MeasuredRun measured(std::size_t k) {
  const auto pace = static_cast<double>(k + 2);
  const auto course = sensor::Course({}).slide(1.6e-3, 0.1 * pace).rest(0.15, 0.2, 40e5).slide(0.5e-3, 0.05 * pace);
  sensor::ClosedFormRun run(valve_number(k), course);
  const double sample_step_s = 0.4e-3 * static_cast<double>(1 + k % 4);
  MeasuredRun out;
  double time_s = 17.0 * static_cast<double>(k);
  for (const sensor::ValveSample& sample : run.sampled(course.end_s(), sample_step_s)) {
    out.time_s.push_back(time_s += sample_step_s);
    out.current_A.push_back(sample.measured.current_A);
    out.voltage_V.push_back(sample.measured.voltage_V);
    out.position_m.push_back(sample.measured.position_m);
    out.oil_temperature_K.push_back(sample.measured.oil_temperature_K);
  }
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t s = 0; s < 3 * k; ++s) out.current_A[s] = nothing;  // valve k answers after 3 k samples
  out.position_m[out.position_m.size() / 2] = nothing;
  out.time_s[out.time_s.size() / 3] = out.time_s[out.time_s.size() / 3 - 1];
  if (k == 4) out.time_s[out.time_s.size() / 4] = nothing;
  return out;
}

constexpr double rated_flow_m3_per_s = 1e-3;

/// One valve alone, in single precision as in the batch.
Answers alone(const Observer& valve, const Columns& columns) {
  sensor::ObserverState<float> state;
  SampleTimes times;
  Answers out;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto given = times.next<float>(columns[k]);
    out.push_back(step(valve, state, given.sample));
    times.finish(out.back(), given, rated_flow_m3_per_s);
  }
  return out;
}

bool alike(const sensor::Estimate<float>& a, const sensor::Estimate<float>& b) {
  const auto near = [](float one, float other, float size) { return std::abs(one - other) <= 1e-5F * size; };
  return near(a.flow_m3_per_s, b.flow_m3_per_s, 1e-3F) && near(a.flow_lower_m3_per_s, b.flow_lower_m3_per_s, 1e-3F) &&
         near(a.flow_upper_m3_per_s, b.flow_upper_m3_per_s, 1e-3F) &&
         near(a.pressure_difference_Pa, b.pressure_difference_Pa, 1e7F) &&
         near(a.magnetic_force_N, b.magnetic_force_N, 100) && near(a.spring_force_N, b.spring_force_N, 100) &&
         near(a.flow_force_N, b.flow_force_N, 100) && near(a.friction_force_N, b.friction_force_N, 100) &&
         a.status == b.status;
}

class RunningBatchTest : public testing::TestWithParam<InstructionSet> {
 protected:
  static constexpr std::size_t valves = 11;  // no multiple of what a register holds
  void SetUp() override {
    for (std::size_t k = 0; k < valves; ++k) {
      models.push_back(sensor::closed_form_observer<float>(valve_number(k)));
      runs.push_back(measured(k));
    }
    for (const Observer& model : models) in_batch.push_back({&model, rated_flow_m3_per_s});
  }
  /// The runs in `pieces` calls, each valve's divided for itself.
  std::vector<Answers> together(std::size_t pieces) const {
    RunningBatch<Observer> running(in_batch, GetParam());
    std::vector<Answers> out(valves);
    for (std::size_t k = 0; k < valves; ++k) out[k].resize(runs[k].time_s.size());
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      std::vector<Columns> columns;
      std::vector<std::span<sensor::Estimate<float>>> answers;
      for (std::size_t k = 0; k < valves; ++k) {
        const std::size_t begin = runs[k].time_s.size() * piece / pieces;
        const std::size_t end = runs[k].time_s.size() * (piece + 1) / pieces;
        columns.push_back(runs[k].from(begin, end));
        answers.push_back(std::span(out[k]).subspan(begin, end - begin));
      }
      running.run(columns, answers);
    }
    return out;
  }

  std::vector<Observer> models;
  std::vector<MeasuredRun> runs;
  std::vector<BatchedValve<Observer>> in_batch;
};
INSTANTIATE_TEST_SUITE_P(Batch, RunningBatchTest, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name(set.param)); });

TEST_P(RunningBatchTest, AnswersRunsOfUnequalLengthAndRateAsEachSensorAlone) {
  for (const std::size_t pieces : {1U, 7U}) {
    const std::vector<Answers> answers = together(pieces);
    for (std::size_t k = 0; k < valves; ++k) {
      const Answers expected = alone(models[k], runs[k].all());
      ASSERT_EQ(answers[k].size(), expected.size());
      std::size_t apart = 0;
      for (std::size_t s = 0; s < expected.size(); ++s) {
        if (!alike(answers[k][s], expected[s]) && ++apart == 1)
          ADD_FAILURE() << "valve " << k << ", sample " << s << ", in " << pieces << " pieces";
      }
      EXPECT_EQ(apart, 0U) << "valve " << k;
    }
  }
}

TEST_P(RunningBatchTest, KnowsNothingOfAValveBeforeItsOwnFirstCompleteSample) {
  const std::vector<Answers> answers = together(1);
  for (std::size_t k = 0; k < valves; ++k) {
    for (std::size_t s = 0; s < 3 * k; ++s) {
      EXPECT_EQ(answers[k][s].flow_m3_per_s, 0) << k;
      EXPECT_FLOAT_EQ(answers[k][s].flow_upper_m3_per_s, static_cast<float>(rated_flow_m3_per_s)) << k;
    }
    EXPECT_FALSE(has(answers[k][3 * k].status, sensor::Status::sample_missing)) << k;
  }
}

TEST(RunningBatch, RefusesNoValvesAndRunsThatAreNotTheirs) {
  using Batch = RunningBatch<Observer>;
  EXPECT_THROW(Batch(std::span<const BatchedValve<Observer>>()), std::invalid_argument);
  const Observer model = sensor::closed_form_observer<float>(valve_number(0));
  const std::vector<BatchedValve<Observer>> one{{&model, rated_flow_m3_per_s}};
  Batch batch(one);
  EXPECT_EQ(batch.size(), 1U);
  const MeasuredRun run = measured(0);
  Answers answers(run.time_s.size() - 1);
  const std::vector<Columns> columns{run.all()};
  const std::vector<std::span<sensor::Estimate<float>>> too_short{answers};
  EXPECT_THROW(batch.run(columns, {}), std::invalid_argument);
  EXPECT_THROW(batch.run(columns, too_short), std::invalid_argument);
}

/// Valve `k` goes out and back, to either side in turn; both coils have their instruments, but those of valve 3.
struct MeasuredWholeRun {
  std::vector<double> time_s, current_b_A, voltage_b_V, position_m, oil_temperature_K, current_a_A, voltage_a_V;

  explicit MeasuredWholeRun(std::size_t k) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const MeasuredRun one_side = measured(k);
    const auto size = static_cast<std::ptrdiff_t>(one_side.time_s.size());
    for (std::ptrdiff_t s = -size + 1; s < size; ++s) {  // backwards to one side's beginning, then to the other's end
      const auto at = static_cast<std::size_t>(s < 0 ? -s : s);
      const bool side_a = (s < 0) == (k % 2 == 0);
      time_s.push_back(1e-3 * static_cast<double>(s + size));
      const double current_A = one_side.current_A[at], voltage_V = one_side.voltage_V[at];
      current_a_A.push_back(side_a ? current_A : 0);
      voltage_a_V.push_back(side_a ? voltage_V : 0);
      current_b_A.push_back(side_a ? 0 : current_A);
      voltage_b_V.push_back(side_a ? 0 : voltage_V);
      const double opening_m = one_side.position_m[at];
      position_m.push_back(side_a ? -opening_m : opening_m);
      oil_temperature_K.push_back(one_side.oil_temperature_K[at]);
    }
    if (k == 3) {
      for (std::size_t s = 0; s < time_s.size(); ++s) {
        if (position_m[s] < 0) current_b_A[s] = current_a_A[s];
      }
      current_a_A.clear();
      voltage_a_V.clear();
      voltage_b_V.assign(time_s.size(), nothing);
    }
    if (k == 5) current_a_A.front() = std::numeric_limits<double>::infinity();  // missing now
  }
  [[nodiscard]] Columns all() const {
    return {time_s, current_b_A, voltage_b_V, position_m, oil_temperature_K, current_a_A, voltage_a_V};
  }
};

TEST(RunningBatch, RunsWholeValvesAsEachRunningSensorAlone) {
  constexpr std::size_t valves = 10;
  std::vector<Observer> b, a;
  std::vector<sensor::ObserverParameters<double>> b_double, a_double;
  std::vector<MeasuredWholeRun> runs;
  for (std::size_t k = 0; k < valves; ++k) {
    b.push_back(sensor::closed_form_observer<float>(valve_number(k)));
    a.push_back(sensor::closed_form_observer<float>(valve_number(k + 2)));
    b_double.push_back(sensor::closed_form_observer<double>(valve_number(k)));
    a_double.push_back(sensor::closed_form_observer<double>(valve_number(k + 2)));
    runs.emplace_back(k);
  }
  using Whole = sensor::WholeValveParameters<float>;
  std::vector<Whole> models;
  for (std::size_t k = 0; k < valves; ++k) models.push_back({&b[k], &a[k]});
  std::vector<BatchedValve<Whole>> in_batch;
  std::vector<Columns> columns;
  std::vector<Answers> answers(valves);
  std::vector<std::span<sensor::Estimate<float>>> room;
  for (std::size_t k = 0; k < valves; ++k) {
    in_batch.push_back({&models[k], rated_flow_m3_per_s});
    columns.push_back(runs[k].all());
    answers[k].resize(columns[k].size());
    room.emplace_back(answers[k]);
  }
  RunningBatch<Whole>(in_batch).run(columns, room);
  EXPECT_FLOAT_EQ(answers[5][0].flow_lower_m3_per_s, -static_cast<float>(rated_flow_m3_per_s));  // nothing known yet

  for (std::size_t k = 0; k < valves; ++k) {
    RunningSensor alone(sensor::WholeValveParameters<double>{&b_double[k], &a_double[k]}, rated_flow_m3_per_s);
    std::vector<double> apart;
    double least = 0, most = 0;
    for (std::size_t s = 0; s < columns[k].size(); ++s) {
      const sensor::Estimate<double> expected = alone.step(columns[k][s]);
      least = std::min(least, expected.flow_m3_per_s);
      most = std::max(most, expected.flow_m3_per_s);
      apart.push_back(std::abs(answers[k][s].flow_m3_per_s - expected.flow_m3_per_s));
    }
    EXPECT_LT(least, -1e-4) << k;
    EXPECT_GT(most, 1e-4) << k;
    // Single beside double precision: here and there a break-away is told a sample earlier.
    std::sort(apart.begin(), apart.end());
    EXPECT_LT(apart[apart.size() * 99 / 100], 1e-3 * rated_flow_m3_per_s) << k;
  }
}

TEST(RunningBatch, RefusesTheRunOfAWholeValveWhereItsValvesAreOfOneDirection) {
  const Observer model = sensor::closed_form_observer<float>(valve_number(0));
  const std::vector<BatchedValve<Observer>> one{{&model, rated_flow_m3_per_s}};
  RunningBatch<Observer> batch(one);
  const MeasuredRun run = measured(0);
  Answers answers(run.time_s.size());
  std::vector<Columns> columns{run.all()};
  columns[0].current_a_A = columns[0].current_A;
  const std::vector<std::span<sensor::Estimate<float>>> room{answers};
  EXPECT_THROW(batch.run(columns, room), std::invalid_argument);
}

}  // namespace
}  // namespace spoolflow::estimation::batch
