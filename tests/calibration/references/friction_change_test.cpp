/// Friction of one spool from what its two directions say of it, in closed form.
#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/calibration/references/wear_search.hpp"

namespace spoolflow::calibration {
namespace {

double normal(double value, double deviation) {
  return -0.5 * std::pow(value / deviation, 2);
}

/// A direction whose friction is one of two, alike likely, or the same twice.
SeenFriction direction(double one, double other, double deviation) {
  SeenFriction out{{}, {}, false};
  for (std::size_t k = 0; k < tried_frictions; ++k) {
    out.with_wider_edges[k] = std::log(std::exp(normal(tried_log_friction(k) - one, deviation)) +
                                       std::exp(normal(tried_log_friction(k) - other, deviation)));
  }
  out.with_these_edges = out.with_wider_edges;
  return out;
}

TEST(FrictionChange, TheOtherDirectionDecidesBetweenTwoFrictionsThatOneDirectionAllows) {
  const SeenFriction either = direction(0.3, -0.4, 0.1), rough = direction(0.25, 0.25, 0.2);
  const Change alone = friction_change(std::vector{either}), both = friction_change(std::vector{either, rough});
  EXPECT_GT(alone.deviation, 0.2);
  EXPECT_NEAR(both.value, 0.25, 0.05);
  EXPECT_LT(both.deviation, 0.13);
}

TEST(FrictionChange, IsNotKnownBetterThanTheModelKnowsThatOfAHealthyValve) {
  const SeenFriction sharp = direction(0.3, 0.3, 0.03);
  const Change change = friction_change(std::vector{sharp, sharp, sharp});
  EXPECT_NEAR(change.value, 0.28, 0.03);
  EXPECT_GT(change.deviation, 0.8 * Priors::model_friction_share);
  EXPECT_TRUE(change.taken);
}

TEST(FrictionChange, StaysWhereTheReferencesAgreeWithTheModelAndIsTakenWhereOtherWearShows) {
  SeenFriction healthy = direction(0.05, 0.05, 0.1);
  EXPECT_LT(friction_change(std::vector{healthy}).evidence, 0);
  EXPECT_FALSE(friction_change(std::vector{healthy}).taken);
  healthy.wears = true;
  EXPECT_TRUE(friction_change(std::vector{healthy}).taken);
}

TEST(FrictionChange, MoreAndLessFrictionAreTakenByTheSameEvidence) {
  for (const double log_ratio : {0.235, 0.5}) {
    const Change up = friction_change(std::vector{direction(log_ratio, log_ratio, 0.1)}),
                 down = friction_change(std::vector{direction(-log_ratio, -log_ratio, 0.1)});
    EXPECT_NEAR(up.evidence, down.evidence, 0.05);
    EXPECT_EQ(up.taken, log_ratio > 0.4);
    EXPECT_EQ(down.taken, log_ratio > 0.4);
  }
}

TEST(FrictionChange, OilThatAsksForWiderEdgesIsEvidenceOfItsOwn) {
  SeenFriction seen = direction(0.1, 0.1, 0.1);
  const double before = friction_change(std::vector{seen}).evidence;
  for (double& each : seen.with_wider_edges) each += 3;
  EXPECT_NEAR(friction_change(std::vector{seen}).evidence, before + 3, 1e-9);
}

}  // namespace
}  // namespace spoolflow::calibration
