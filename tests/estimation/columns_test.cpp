#include "spoolflow/estimation/columns.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "tests/sensor/linear_valve.hpp"

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

struct Row {
  double time_s, current_A, position_m;
};

using Estimates = std::vector<sensor::Estimate<double>>;

Estimates run(RunningSensor& sensor, const std::vector<Row>& rows) {
  std::vector<double> time_s, current_A, position_m;
  for (const Row& row : rows) {
    time_s.push_back(row.time_s);
    current_A.push_back(row.current_A);
    position_m.push_back(row.position_m);
  }
  Estimates out(rows.size());
  run(sensor,
      {.time_s = time_s, .current_A = current_A, .voltage_V = {}, .position_m = position_m, .oil_temperature_K = {}},
      out);
  return out;
}

TEST(Columns, AnswersEverySampleOnce) {
  const model::Model model = linear_model();
  RunningSensor sensor = running_sensor(model, Estimator::condensed);
  const Estimates out = run(sensor, {{0, 1.5, 1e-3}, {1e-3, 1.5, 1e-3}, {1e-3, 2.0, 1e-3}});
  ASSERT_EQ(out.size(), 3U);
  EXPECT_NEAR(out[0].flow_m3_per_s, 1e-3 * std::sqrt(20.0 / 50), 1e-9);
  EXPECT_NEAR(out[2].flow_m3_per_s, 1e-3 * std::sqrt(30.0 / 50), 1e-9);
}

TEST(Columns, BeforeItsFirstCompleteSampleAnswersZeroWithTheWholeRangeAsBand) {
  const model::Model model = linear_model();
  RunningSensor sensor = running_sensor(model, Estimator::condensed);
  const Estimates out = run(sensor, {{0, missing, 1e-3}, {1e-3, 1.5, missing}, {2e-3, 1.5, 1e-3}});
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_EQ(out[k].flow_m3_per_s, 0);
    EXPECT_EQ(out[k].flow_lower_m3_per_s, 0);
    EXPECT_EQ(out[k].flow_upper_m3_per_s, 1e-3);
    EXPECT_TRUE(sensor::has(out[k].status, Status::sample_missing));
  }
  EXPECT_GT(out[2].flow_m3_per_s, 0);
  EXPECT_FALSE(sensor::has(out[2].status, Status::sample_missing));
}

TEST(Columns, HoldsItsAnswerOverMissingSamplesAndAcrossBlocks) {
  const model::Model model = linear_model();
  RunningSensor sensor = running_sensor(model, Estimator::condensed);
  const Estimates first = run(sensor, {{0, 1.5, 1e-3}});
  const Estimates second = run(sensor, {{1e-3, missing, 1e-3}, {2e-3, missing, missing}});
  for (const auto& held : second) {
    EXPECT_EQ(held.flow_m3_per_s, first[0].flow_m3_per_s);
    EXPECT_TRUE(sensor::has(held.status, Status::sample_missing));
  }
}

TEST(Columns, NeverAnswersNaN) {
  const model::Model model = linear_model();
  RunningSensor sensor = running_sensor(model, Estimator::condensed);
  std::vector<Row> rows;
  for (int k = 0; k < 300; ++k) {
    rows.push_back(
        {k < 10 ? 0.0 : k * 0.5, k % 7 == 0 ? missing : k * 0.02 - 1, k % 11 == 0 ? missing : k * 2e-5 - 1e-3});
  }
  for (const auto& estimate : run(sensor, rows)) {
    EXPECT_TRUE(std::isfinite(estimate.flow_m3_per_s));
    EXPECT_TRUE(std::isfinite(estimate.flow_lower_m3_per_s));
    EXPECT_TRUE(std::isfinite(estimate.flow_upper_m3_per_s));
  }
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
