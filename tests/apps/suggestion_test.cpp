#include "spoolflow/apps/suggestion.hpp"

#include <gtest/gtest.h>

namespace spoolflow::apps {
namespace {

const std::vector<std::string> known{"calibrate", "estimate", "inspect", "validate"};

TEST(Suggestion, NamesTheNearestCommand) {
  EXPECT_EQ(suggestion("calibrat", known), "; did you mean 'calibrate'?");
  EXPECT_EQ(suggestion("esitmate", known), "; did you mean 'estimate'?");
}

TEST(Suggestion, StaysSilentWhereNoWordIsNear) {
  EXPECT_EQ(suggestion("frobnicate", known), "");
  EXPECT_EQ(suggestion("x", known), "");
  EXPECT_EQ(suggestion("calibrate", {}), "");
}

}  // namespace
}  // namespace spoolflow::apps
