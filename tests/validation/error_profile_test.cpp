#include "spoolflow/validation/error_profile.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

TEST(ErrorProfile, FindsTheStretchInWhichTheErrorsAreLarge) {
  ErrorProfile profile(10, 1.0);
  for (int k = 0; k < 1000; ++k) profile.add(5, 0.01);
  for (int k = 0; k < 1000; ++k) profile.add(-5, k % 10 == 0 ? -0.2 : 0.02);
  const std::vector<ProfileBin> bins = profile.bins();
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_DOUBLE_EQ(bins[0].from, -10);
  EXPECT_DOUBLE_EQ(bins[0].to, 0);
  EXPECT_NEAR(bins[0].p95_m3_per_s, 0.2, 5e-4);
  EXPECT_NEAR(bins[0].median_m3_per_s, 0.02, 5e-4);
  EXPECT_NEAR(bins[1].p95_m3_per_s, 0.01, 5e-4);
}

TEST(ErrorProfile, SaysNothingOfStretchesWithHardlyAnySample) {
  ErrorProfile profile(1, 1.0);
  for (int k = 0; k < 19; ++k) profile.add(0.5, 0.1);
  for (int k = 0; k < 20; ++k) profile.add(1.5, 0.1);
  profile.add(std::nan(""), 0.1);
  profile.add(1.5, std::nan(""));
  ASSERT_EQ(profile.bins().size(), 1U);
  EXPECT_EQ(profile.bins().front().samples, 20U);
}

TEST(ErrorProfile, OfTwoRunsIsThatOfAllTheirSamples) {
  ErrorProfile one(1, 1.0);
  ErrorProfile other(1, 1.0);
  ErrorProfile together(1, 1.0);
  for (int k = 0; k < 500; ++k) {
    ErrorProfile& half = k % 3 == 0 ? one : other;
    half.add(0.3, k * 1e-3);
    together.add(0.3, k * 1e-3);
  }
  one.append(other);
  EXPECT_EQ(one.bins().front().samples, 500U);
  EXPECT_DOUBLE_EQ(one.bins().front().p95_m3_per_s, together.bins().front().p95_m3_per_s);
}

TEST(ErrorProfile, CountsErrorsBeyondFullScaleAsFullScale) {
  ErrorProfile profile(1, 1.0);
  for (int k = 0; k < 100; ++k) profile.add(0.5, 17.0);
  EXPECT_NEAR(profile.bins().front().p95_m3_per_s, 1.0, 5e-4);
}

TEST(ErrorProfile, StatesTheShareInsideTheBandOfEachBin) {
  ErrorProfile profile(1, 1.0);
  for (int k = 0; k < 200; ++k) profile.add(k < 100 ? 0.5 : 1.5, 0.1, k < 100 || k % 4 == 0);
  EXPECT_DOUBLE_EQ(profile.bins()[0].band_coverage, 1);
  EXPECT_DOUBLE_EQ(profile.bins()[1].band_coverage, 0.25);
}

TEST(ErrorProfile, DistributionRisesToEverySample) {
  ErrorProfile profile(1, 1.0);
  EXPECT_EQ(profile.distribution().size(), 1U);
  for (int k = 0; k < 1000; ++k) profile.add(k, k * 1e-4);
  const std::vector<DistributionPoint> points = profile.distribution();
  EXPECT_DOUBLE_EQ(points.back().share, 1);
  EXPECT_NEAR(points.back().error_m3_per_s, 0.1, 1e-3);
  EXPECT_LE(points.size(), 202U);
  for (const DistributionPoint& point : points) EXPECT_NEAR(point.share, 10 * point.error_m3_per_s, 0.01);
}

}  // namespace
}  // namespace spoolflow::validation
