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

TEST(NumberText, KeepsAboutThreeDigits) {
  EXPECT_EQ(three_digits(80), "80.0");
  EXPECT_EQ(three_digits(0.0678), "0.0678");
  EXPECT_EQ(three_digits(1234.5), "1234");
  EXPECT_EQ(three_digits(0), "0");
}

}  // namespace
}  // namespace spoolflow::report
