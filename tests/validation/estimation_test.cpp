#include "spoolflow/validation/estimation.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor/linear_valve.hpp"

namespace spoolflow::validation {
namespace {

using recording::Channel;
using sensor::Status;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

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

recording::SampleBlock block_of(const std::vector<Row>& rows) {
  recording::SampleBlock block;
  const auto column = [&](Channel channel) -> std::vector<double>& {
    return block.columns[static_cast<std::size_t>(channel)];
  };
  for (const Row& row : rows) {
    column(Channel::time).push_back(row.time_s);
    column(Channel::current).push_back(row.current_A);
    column(Channel::position).push_back(row.position_m);
  }
  block.rows = rows.size();
  return block;
}

using Estimates = std::vector<sensor::Estimate<double>>;

Estimates run(Estimation& estimation, const std::vector<Row>& rows) {
  Estimates out;
  estimation.run(block_of(rows), out);
  return out;
}

TEST(Estimation, AnswersEverySampleOnce) {
  const model::Model model = linear_model();
  Estimation estimation(model, Estimator::condensed);
  const Estimates out = run(estimation, {{0, 1.5, 1e-3}, {1e-3, 1.5, 1e-3}, {1e-3, 2.0, 1e-3}});
  ASSERT_EQ(out.size(), 3U);
  EXPECT_NEAR(out[0].flow_m3_per_s, 1e-3 * std::sqrt(20.0 / 50), 1e-9);
  EXPECT_NEAR(out[2].flow_m3_per_s, 1e-3 * std::sqrt(30.0 / 50), 1e-9);
}

TEST(Estimation, BeforeItsFirstCompleteSampleAnswersZeroWithTheWholeRangeAsBand) {
  const model::Model model = linear_model();
  Estimation estimation(model, Estimator::condensed);
  const Estimates out = run(estimation, {{0, nothing, 1e-3}, {1e-3, 1.5, nothing}, {2e-3, 1.5, 1e-3}});
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_EQ(out[k].flow_m3_per_s, 0);
    EXPECT_EQ(out[k].flow_lower_m3_per_s, 0);
    EXPECT_EQ(out[k].flow_upper_m3_per_s, 1e-3);
    EXPECT_TRUE(sensor::has(out[k].status, Status::sample_missing));
  }
  EXPECT_GT(out[2].flow_m3_per_s, 0);
  EXPECT_FALSE(sensor::has(out[2].status, Status::sample_missing));
}

TEST(Estimation, HoldsItsAnswerOverMissingSamplesAndAcrossBlocks) {
  const model::Model model = linear_model();
  Estimation estimation(model, Estimator::condensed);
  const Estimates first = run(estimation, {{0, 1.5, 1e-3}});
  const Estimates second = run(estimation, {{1e-3, nothing, 1e-3}, {2e-3, nothing, nothing}});
  for (const auto& held : second) {
    EXPECT_EQ(held.flow_m3_per_s, first[0].flow_m3_per_s);
    EXPECT_TRUE(sensor::has(held.status, Status::sample_missing));
  }
}

TEST(Estimation, NeverAnswersNaN) {
  const model::Model model = linear_model();
  Estimation estimation(model, Estimator::condensed);
  std::vector<Row> rows;
  for (int k = 0; k < 300; ++k) {
    rows.push_back(
        {k < 10 ? 0.0 : k * 0.5, k % 7 == 0 ? nothing : k * 0.02 - 1, k % 11 == 0 ? nothing : k * 2e-5 - 1e-3});
  }
  for (const auto& estimate : run(estimation, rows)) {
    EXPECT_TRUE(std::isfinite(estimate.flow_m3_per_s));
    EXPECT_TRUE(std::isfinite(estimate.flow_lower_m3_per_s));
    EXPECT_TRUE(std::isfinite(estimate.flow_upper_m3_per_s));
  }
}

TEST(Estimation, AskedForAnObserverThatTheModelLacksSaysWhatToDo) {
  const model::Model model = linear_model();
  EXPECT_THAT([&] { (void)Estimation(model, Estimator::observer); },
              ::testing::ThrowsMessage<model::ModelError>(
                  ::testing::AllOf(::testing::HasSubstr("linear valve"), ::testing::HasSubstr("calibrate"))));
  EXPECT_EQ(best_estimator(model), Estimator::condensed);
}

TEST(StatusText, JoinsTheNamesOfTheSetBits) {
  StatusText text;
  EXPECT_EQ(text(Status::none), "");
  EXPECT_EQ(text(Status::closed), "closed");
  EXPECT_EQ(text(Status::closed | Status::sample_missing), "closed|sample_missing");
  EXPECT_EQ(text(Status::closed), "closed");
}

}  // namespace
}  // namespace spoolflow::validation
