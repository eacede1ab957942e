#include "spoolflow/numerics/median.hpp"

#include <gtest/gtest.h>

namespace spoolflow::numerics {
namespace {

TEST(Median, OfAnEvenNumberIsTheLargerOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 3);
}

TEST(Median, PassesOverMissingValues) {
  EXPECT_EQ(median({NAN, 5, NAN, -1, 7}), 5);
  EXPECT_TRUE(std::isnan(median({NAN})));
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace spoolflow::numerics
