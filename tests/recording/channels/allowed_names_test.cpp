#include "spoolflow/recording/channels/allowed_names.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::recording {
namespace {

const std::vector<std::string> commands{"calibrate", "estimate", "inspect", "validate"};

TEST(DidYouMean, NamesTheNearestName) {
  EXPECT_EQ(did_you_mean("calibrat", commands), "; did you mean 'calibrate'?");
  EXPECT_EQ(did_you_mean("esitmate", commands), "; did you mean 'estimate'?");
}

TEST(DidYouMean, StaysSilentWhereNoNameIsNear) {
  EXPECT_EQ(did_you_mean("frobnicate", commands), "");
  EXPECT_EQ(did_you_mean("x", commands), "");
  EXPECT_EQ(did_you_mean("calibrate", {}), "");
}

}  // namespace
}  // namespace spoolflow::recording
