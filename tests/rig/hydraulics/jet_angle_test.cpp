#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/rig/hydraulics/flow_force.hpp"

namespace spoolflow::rig {
namespace {

/// Opening over clearance that belongs to an angle, exactly (von Mises, as in flow_force.hpp).
double slot_ratio(double angle) {
  using std::numbers::pi;
  const double opening = 1.0 + 0.5 * pi * std::sin(angle) - std::log(std::tan(0.5 * (pi - angle))) * std::cos(angle);
  const double clearance =
      1.0 + 0.5 * pi * std::cos(angle) - std::log(std::tan(0.5 * (0.5 * pi + angle))) * std::sin(angle);
  return opening / clearance;
}

TEST(RigJetAngle, FollowsVonMisesWithinAHundredthOfADegree) {
  constexpr double degree = std::numbers::pi / 180.0;
  for (double angle = 21.2 * degree; angle < 68.8 * degree; angle += 0.1 * degree) {
    const JetDirection jet = jet_direction(slot_ratio(angle), 1.0);
    EXPECT_NEAR(std::atan2(jet.sine, jet.cosine), angle, 0.01 * degree) << angle / degree;
    EXPECT_NEAR(jet.sine * jet.sine + jet.cosine * jet.cosine, 1.0, 1e-12);
  }
}

TEST(RigJetAngle, RunsFrom21DegreesInTheSlotTo69DegreesWideOpen) {
  constexpr double degree = std::numbers::pi / 180.0;
  const JetDirection slot = jet_direction(1e-9, 1.0);
  const JetDirection open = jet_direction(1e9, 1.0);
  EXPECT_NEAR(std::atan2(slot.sine, slot.cosine), 21.13 * degree, 0.01 * degree);
  EXPECT_NEAR(std::atan2(open.sine, open.cosine), 68.87 * degree, 0.01 * degree);
}

}  // namespace
}  // namespace spoolflow::rig
