#include "spoolflow/numerics/meter_lag.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::numerics {
namespace {

/// A flow of steps and ramps, sampled at 1 kHz.
struct Course {
  std::vector<double> time_s, flow;
};

Course course() {
  Course out;
  std::minstd_rand random(7);
  double flow = 0;
  double rate = 0;
  for (int k = 0; k < 20'000; ++k) {
    if (k % 700 == 0) rate = (static_cast<double>(random() % 2001) - 1000) * 1e-5;
    if (k % 1900 == 0) flow += static_cast<double>(random() % 11) - 5;
    out.time_s.push_back(1e-3 * k);
    out.flow.push_back(flow += rate);
  }
  return out;
}

TEST(MeterLag, AStepIsShownAfterTheDeadTimeAndByTwoThirdsOneLagLater) {
  std::vector<double> time_s, flow;
  for (int k = 0; k < 200; ++k) {
    time_s.push_back(1e-3 * k);
    flow.push_back(k < 50 ? 0 : 1);
  }
  apply_lag<double>(time_s, flow, {.dead_time_s = 0.02, .lag_s = 0.03});
  EXPECT_EQ(flow[69], 0);
  EXPECT_NEAR(flow[69 + 30], 1 - std::exp(-1.0), 1e-12);
}

TEST(MeterLag, IsFoundFromWhatTheMeterShowed) {
  const Course course = numerics::course();
  for (const MeterLag& meter : {MeterLag{0, 0.03}, MeterLag{0.012, 0.05}, MeterLag{0, 0}}) {
    std::vector<double> shown = course.flow;
    apply_lag<double>(course.time_s, shown, meter);
    std::minstd_rand random(3);
    for (double& value : shown) value += 0.5 + 1e-3 * static_cast<double>(random() % 200);  // offset and noise
    const std::optional<MeterLag> found = find_meter_lag(course.time_s, course.flow, shown);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->lag_s, meter.lag_s, 0.003) << meter.dead_time_s << ' ' << meter.lag_s;
    EXPECT_NEAR(found->dead_time_s, meter.dead_time_s, 0.003);
  }
}

/// Dead time and lag look alike but for what the meter smooths: together they are found better than each.
TEST(MeterLag, OfAMeterBehindABusIsFoundUpToHalfASecondOfDeadTime) {
  const Course course = numerics::course();
  for (const MeterLag& meter : {MeterLag{0.2, 0.03}, MeterLag{0.25, 0.03}, MeterLag{0.45, 0.1}}) {
    std::vector<double> shown = course.flow;
    apply_lag<double>(course.time_s, shown, meter);
    const std::optional<MeterLag> found = find_meter_lag(course.time_s, course.flow, shown);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->lag_s + found->dead_time_s, meter.lag_s + meter.dead_time_s, 0.005);
    EXPECT_NEAR(found->dead_time_s, meter.dead_time_s, 0.02);
  }
}

TEST(MeterLag, AMissingSampleShowsWhatWasShownBefore) {
  std::vector<double> time_s{0, 0.01, 0.02, 0.03};
  std::vector<double> flow{1, 1, std::nan(""), 1};
  apply_lag<double>(time_s, flow, {.lag_s = 0.03});
  EXPECT_EQ(flow, std::vector<double>({1, 1, 1, 1}));
}

TEST(MeterLag, IsNotFoundWhereItWouldButSmoothTheFlowsOwnErrors) {
  const Course course = numerics::course();
  std::vector<double> wrong = course.flow;
  for (std::size_t k = 0; k < wrong.size(); ++k) wrong[k] += (k / 150) % 2 == 0 ? 2.0 : -2.0;
  EXPECT_FALSE(find_meter_lag(course.time_s, wrong, course.flow));
  EXPECT_FALSE(find_lag_of_known_flow(course.time_s, std::vector<double>(wrong.size(), 1.0), course.flow));
}

TEST(MeterLag, OfAKnownFlowShowsBesideSlowStrokesAndANoisyMeterThatReadsTooMuch) {
  std::vector<double> time_s, flow;
  for (int k = 0; k < 40'000; ++k) {
    time_s.push_back(1e-3 * k);
    flow.push_back(k < 20'000 ? 0.005 * k : 0.005 * (40'000 - k));  // of 100, at 5 a second
  }
  for (const MeterLag& meter : {MeterLag{0, 0.03}, MeterLag{0, 0.1}, MeterLag{0, 0}}) {
    std::vector<double> shown = flow;
    apply_lag<double>(time_s, shown, meter);
    std::minstd_rand random(3);
    for (double& value : shown) value = 1.02 * value + 0.5 + 5e-3 * (static_cast<double>(random() % 200) - 100);
    const std::optional<MeterLag> found = find_lag_of_known_flow(time_s, flow, shown);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->dead_time_s + found->lag_s, meter.lag_s, 0.002) << meter.lag_s;
    EXPECT_FALSE(find_meter_lag(time_s, flow, shown)) << "its changes drown in noise";
  }
}

TEST(MeterLag, TooFewSamplesShowNone) {
  const std::vector<double> few(10, 1.0);
  EXPECT_FALSE(find_meter_lag(few, few, few));
  EXPECT_FALSE(find_lag_of_known_flow(few, few, few));
}

}  // namespace
}  // namespace spoolflow::numerics
