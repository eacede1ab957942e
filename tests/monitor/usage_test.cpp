#include "spoolflow/monitor/usage.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/monitor/status_share.hpp"

namespace spoolflow::monitor {
namespace {

constexpr UsageScale scale{2e-3, 1e-3, 70e5};

/// To and fro between 0 and 1 mm, each way in a second, with a vibration of 2 um.
Usage triangles(int ways) {
  Usage usage;
  for (int way = 0; way < ways; ++way) {
    for (int k = 0; k < 1000; ++k) {
      const double share = k / 1000.0;
      const double tremble_m = k % 2 == 0 ? 2e-6 : -2e-6;
      count(usage, scale, {1e-3, 1e-3 * (way % 2 == 0 ? share : 1 - share) + tremble_m, true, 0.5e-3, 35e5});
    }
  }
  return usage;
}

TEST(Usage, CountsStrokesReversalsAndDistance) {
  const Usage usage = triangles(10);
  EXPECT_EQ(usage.strokes, 10U);
  EXPECT_EQ(usage.reversals, 9U);
  EXPECT_NEAR(usage.distance_m, 10e-3, 0.2e-3);
  EXPECT_NEAR(usage.watched_s, 10, 1e-9);
}

TEST(Usage, TrembleIsNoDistance) {
  Usage usage;
  for (int k = 0; k < 100000; ++k) count(usage, scale, {1e-3, k % 2 == 0 ? 2e-6 : -2e-6, true, 0, 0});
  EXPECT_EQ(usage.strokes, 0U);
  EXPECT_EQ(usage.distance_m, 0);
}

TEST(Usage, EnergyIsPressureTimesVolume) {
  const Usage usage = triangles(4);
  EXPECT_NEAR(usage.volume_m3, 4 * 0.5e-3, 1e-12);
  EXPECT_NEAR(usage.energy_J, usage.volume_m3 * 35e5, 1e-6);
  EXPECT_NEAR(usage.load_s[2 * load_classes + 2], 4, 1e-9);  // half flow at half pressure: the third class of each
}

TEST(StatusShares, AFaultThatLastsIsAFailureAndOneSampleIsNone) {
  StatusShares shares;
  follow_status(shares, sensor::Status::coil_fault, 1e-3);
  EXPECT_EQ(sign_of(shares), Ne107::good);
  for (int k = 0; k < 20000; ++k) follow_status(shares, sensor::Status::coil_fault, 1e-3);
  EXPECT_EQ(sign_of(shares), Ne107::failure);
  for (int k = 0; k < 60000; ++k) follow_status(shares, sensor::Status::none, 1e-3);
  EXPECT_EQ(sign_of(shares), Ne107::good);
}

TEST(StatusShares, AFaultLongAgoIsForgottenBeforeItsShareIsNoOrdinaryNumber) {
  StatusShares shares;
  follow_status(shares, sensor::Status::coil_fault, 1e-3);
  for (int second = 0; second < 86400; ++second) {
    follow_status(shares, sensor::Status::none, 1);
    for (const double share : shares.share) ASSERT_NE(std::fpclassify(share), FP_SUBNORMAL) << second;
  }
  EXPECT_EQ(shares.share, StatusShares{}.share);
}

TEST(StatusShares, MissingSamplesAreAFunctionCheck) {
  StatusShares shares;
  for (int k = 0; k < 20000; ++k) follow_status(shares, sensor::Status::sample_missing, 1e-3);
  EXPECT_EQ(sign_of(shares), Ne107::function_check);
}

}  // namespace
}  // namespace spoolflow::monitor
