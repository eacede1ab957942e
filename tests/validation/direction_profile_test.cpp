#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/validation/error_profile.hpp"

namespace spoolflow::validation {
namespace {

constexpr double stroke_m = 2.4e-3;

/// Errors of `opening` and `closing` over the whole stroke; while closing one more above 2 mm.
DirectionProfile loop(double opening, double closing, int samples = 2400) {
  DirectionProfile out({stroke_m, 1});
  for (int k = 0; k < samples; ++k) {
    const double position_m = stroke_m * (k + 0.5) / samples;
    out.add(Direction::opening, position_m, opening);
    out.add(Direction::closing, position_m, position_m > 2e-3 ? closing - 0.02 : closing);
  }
  return out;
}

TEST(DirectionProfile, FindsTheWidestPlaceOfTheLoop) {
  const DirectionProfile profile = loop(0.01, -0.01);
  const auto hysteresis = profile.hysteresis();
  ASSERT_TRUE(hysteresis);
  EXPECT_NEAR(hysteresis->difference_m3_per_s, 0.04, 1e-12);
  EXPECT_GT(hysteresis->position_m, 2e-3);
  EXPECT_NEAR(profile.bins().front().closing_m3_per_s, -0.01, 1e-12);
}

TEST(DirectionProfile, StatesTheErrorsOfEachDirection) {
  DirectionProfile profile = loop(0.1, -0.01);
  EXPECT_NEAR(profile.magnitudes(Direction::opening)->p95_m3_per_s, 0.1, 1e-3);
  EXPECT_NEAR(profile.magnitudes(Direction::closing)->median_m3_per_s, 0.01, 1e-3);
  EXPECT_FALSE(profile.magnitudes(Direction::rest));
  DirectionProfile rest({stroke_m, 1});
  for (int k = 0; k < 100; ++k) rest.add(Direction::rest, 1e-3, 0.5);
  profile.append(rest);
  EXPECT_EQ(profile.magnitudes(Direction::rest)->samples, 100U);
  EXPECT_EQ(profile.bins().size(), 24U) << "rest belongs to no direction";
}

TEST(DirectionProfile, OfAWholeValveReachesToBothEndsOfTheStroke) {
  DirectionProfile profile({stroke_m, 1, true});
  for (int k = 0; k < 4800; ++k) {
    const double position_m = stroke_m * ((k + 0.5) / 2400 - 1);
    profile.add(Direction::opening, position_m, position_m < -2e-3 ? -0.03 : 0.01);
    profile.add(Direction::closing, position_m, 0);
  }
  EXPECT_EQ(profile.bins().size(), 48U);
  EXPECT_NEAR(profile.bins().front().from_m, -stroke_m, 1e-12);
  EXPECT_NEAR(profile.bins().back().to_m, stroke_m, 1e-12);
  EXPECT_LT(profile.hysteresis()->position_m, -2e-3);
}

TEST(DirectionProfile, OfOneDirectionHasNoHysteresis) {
  DirectionProfile profile({stroke_m, 1});
  for (int k = 0; k < 1000; ++k) profile.add(Direction::opening, 1e-3, 0.1);
  profile.add(Direction::closing, std::nan(""), 0.1);
  profile.add(Direction::closing, -1e-4, 0.1);
  profile.add(Direction::closing, 2 * stroke_m, 0.1);
  EXPECT_TRUE(profile.bins().empty());
  EXPECT_FALSE(profile.hysteresis());
}

}  // namespace
}  // namespace spoolflow::validation
