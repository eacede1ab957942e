/// What the observer leaves open of the pressure difference.
#include "spoolflow/uncertainty/pressure_belief.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/uncertainty/distribution.hpp"

namespace spoolflow::uncertainty {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

PressureBelief::Parts sliding() {
  return {.deviation_Pa = 1e5,
          .below_Pa = infinite,
          .above_Pa = infinite,
          .bounds_Pa = 0,
          .pressure_difference_Pa = 40e5,
          .highest_Pa = 70e5,
          .conductance = 2e-7};
}

TEST(PressureBelief, IsNormalWhileTheSpoolSlides) {
  const PressureBelief belief(sliding());
  EXPECT_DOUBLE_EQ(belief.standard_uncertainty_Pa(), 1e5);
  // Q = C sqrt(dp): one bar of 40 is 1/80 of the flow.
  const double flow = 2e-7 * std::sqrt(40e5);
  EXPECT_NEAR(belief.flow_uncertainty_m3_per_s(), flow / 80, 1e-4 * flow / 80);
  EXPECT_NEAR(belief.flow_error_m3_per_s(1), flow - 2e-7 * std::sqrt(39e5), 1e-15);
  EXPECT_EQ(belief.flow_error_m3_per_s(0), 0);
}

TEST(PressureBelief, IsEvenWithinNarrowBoundsOfFriction) {
  PressureBelief::Parts parts = sliding();
  parts.deviation_Pa = 100e5;
  parts.below_Pa = parts.above_Pa = 1e5;
  const PressureBelief belief(parts);
  EXPECT_NEAR(belief.standard_uncertainty_Pa(), 1e5 / std::numbers::sqrt3, 10);
  const double largest = belief.flow_error_m3_per_s(6);
  EXPECT_NEAR(largest, 2e-7 * (std::sqrt(40e5) - std::sqrt(39e5)), 1e-9);
  EXPECT_NEAR(belief.flow_error_m3_per_s(normal_quantile(0.75)), 0.5 * largest, 0.01 * largest);
}

TEST(PressureBelief, UncertainBoundsWidenOnlyWhatTheyCut) {
  PressureBelief::Parts parts = sliding();
  parts.bounds_Pa = 0.5e5;
  parts.below_Pa = parts.above_Pa = 10e5;  // ten deviations away
  EXPECT_NEAR(PressureBelief(parts).standard_uncertainty_Pa(), 1e5, 1);
  parts.deviation_Pa = 100e5;
  parts.below_Pa = parts.above_Pa = 1e5;
  EXPECT_NEAR(PressureBelief(parts).standard_uncertainty_Pa(), std::hypot(1e5 / std::numbers::sqrt3, 0.5e5), 50);
}

TEST(PressureBelief, BeyondItsOnlyBoundItKnowsNothing) {
  PressureBelief::Parts parts = sliding();
  parts.below_Pa = -3e5;  // the gauge excludes what is believed
  parts.above_Pa = 1e5;
  const PressureBelief belief(parts);
  EXPECT_GE(belief.flow_error_m3_per_s(-3), 0) << "the truth lies below the belief";
  parts.deviation_Pa = 0;
  EXPECT_EQ(PressureBelief(parts).flow_error_m3_per_s(2), 0);
}

}  // namespace
}  // namespace spoolflow::uncertainty
