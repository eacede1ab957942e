#include "spoolflow/report/text/number_text.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::report {
namespace {

TEST(NumberText, HasATrueMinusAndNoNegativeZero) {
  EXPECT_EQ(fixed(-1.25, 1), "\u22121.2");
  EXPECT_EQ(fixed(-0.001, 1), "0.0");
  EXPECT_EQ(signed_fixed(0.5, 1), "+0.5");
  EXPECT_EQ(signed_fixed(0.001, 1), "0.0");
  EXPECT_EQ(signed_fixed(-0.5, 1), "\u22120.5");
}

TEST(NumberText, ShowsADashForWhatIsNotKnown) {
  EXPECT_EQ(fixed(std::nan(""), 2), "\u2013");
  EXPECT_EQ(three_digits(INFINITY), "\u2013");
}

TEST(NumberText, StatesAnUncertaintyByTwoDigits) {
  EXPECT_EQ(two_digits(3.378), "3.4");
  EXPECT_EQ(two_digits(0.2949), "0.29");
  EXPECT_EQ(two_digits(12.91), "13");
  EXPECT_EQ(two_digits(9.96), "10");
  EXPECT_EQ(two_digits(0.996), "1.0");
  EXPECT_EQ(two_digits(123.4), "123");
  EXPECT_EQ(two_digits(0), "0.0");
  EXPECT_EQ(two_digits(0.0004), "0.000");
  EXPECT_EQ(two_digits(std::nan("")), "\u2013");
  EXPECT_EQ(signed_two_digits(-0.0123), "\u22120.012");
  EXPECT_EQ(signed_two_digits(1.26), "+1.3");
}

TEST(NumberText, KeepsAboutThreeDigits) {
  EXPECT_EQ(three_digits(80), "80.0");
  EXPECT_EQ(three_digits(0.0678), "0.0678");
  EXPECT_EQ(three_digits(1234.5), "1234");
  EXPECT_EQ(three_digits(0), "0");
}

}  // namespace
}  // namespace spoolflow::report
