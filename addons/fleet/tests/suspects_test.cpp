#include "addons/fleet/suspects.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fleet {
namespace {

TEST(Suspects, TheBlockThatIsRefusedAloneIsPassedOverAndTheValveGoesOn) {
  Suspects suspects;
  EXPECT_TRUE(suspects.refused("v", {1, 9}, 3, "why"));  // blocks 7 to 9 together
  EXPECT_TRUE(suspects.has("v"));
  EXPECT_FALSE(suspects.has("w"));
  suspects.committed("v", {1, 7});
  EXPECT_TRUE(suspects.refused("v", {1, 8}, 1, "why"));
  EXPECT_EQ(suspects.reason("v", {1, 8}), "refused by the store: why");
  EXPECT_FALSE(suspects.reason("v", {1, 7}) || suspects.reason("v", {2, 8}) || suspects.reason("w", {1, 8}));
  suspects.committed("v", {1, 8});
  EXPECT_TRUE(suspects.has("v"));
  suspects.committed("v", {1, 9});
  EXPECT_FALSE(suspects.any());
}

TEST(Suspects, AValveOfWhichNotEvenThePassedOverBlockIsTakenStands) {
  Suspects suspects;
  EXPECT_TRUE(suspects.refused("v", {1, 8}, 1, "why"));
  EXPECT_FALSE(suspects.stands("v"));
  EXPECT_FALSE(suspects.refused("v", {1, 8}, 1, "why"));
  EXPECT_TRUE(suspects.stands("v"));
  EXPECT_FALSE(suspects.stands("w"));
}

}  // namespace
}  // namespace spoolflow::fleet
