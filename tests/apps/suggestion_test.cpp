#include "spoolflow/apps/suggestion.hpp"

#include <gtest/gtest.h>

namespace spoolflow::apps {
namespace {

const std::vector<std::string> commands{"calibrate", "estimate", "inspect", "validate"};

TEST(Suggestion, NamesTheNearestCommand) {
  EXPECT_EQ(suggestion("calibrat", commands), "; did you mean 'calibrate'?");
  EXPECT_EQ(suggestion("esitmate", commands), "; did you mean 'estimate'?");
}

TEST(Suggestion, StaysSilentWhereNoWordIsNear) {
  EXPECT_EQ(suggestion("frobnicate", commands), "");
  EXPECT_EQ(suggestion("x", commands), "");
  EXPECT_EQ(suggestion("calibrate", {}), "");
}

}  // namespace
}  // namespace spoolflow::apps
