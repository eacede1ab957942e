#include "spoolflow/rig/numerics/elementary_functions.hpp"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

/// Distance in units of the last place of `exact`.
double distance_ulp(double value, double exact) {
  const double ulp = std::nextafter(std::abs(exact), std::numeric_limits<double>::infinity()) - std::abs(exact);
  return std::abs(value - exact) / ulp;
}

TEST(ElementaryFunctions, AreWithinTwoUnitsInTheLastPlaceOfTheLibrarys) {
  for (double x = -699.3; x < 700; x += 0.2718281) EXPECT_LE(distance_ulp(exponential(x), std::exp(x)), 2) << x;
  for (double x = -0.4; x < 0.4; x += 1.234e-4) EXPECT_LE(distance_ulp(exponential(x), std::exp(x)), 2) << x;
  for (double x = 1e-300; x < 1e300; x *= 1.2345) EXPECT_LE(distance_ulp(natural_logarithm(x), std::log(x)), 2) << x;
  for (double x = 0.5; x < 2; x += 1.0001e-3) EXPECT_LE(distance_ulp(natural_logarithm(x), std::log(x)), 2) << x;
  for (double turns = -3; turns < 3; turns += 1.0007e-3) {
    EXPECT_NEAR(sine_of_turns(turns), std::sin(2 * std::numbers::pi * turns), 5e-15) << turns;
  }
}

TEST(ElementaryFunctions, MeetTheirExactValues) {
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-1e9), 0);
  EXPECT_EQ(exponential(1e9), HUGE_VAL);
  EXPECT_TRUE(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(natural_logarithm(1), 0);
  EXPECT_EQ(sine_of_turns(0), 0);
  EXPECT_EQ(sine_of_turns(1e6), 0);
  EXPECT_NEAR(sine_of_turns(0.25), 1, 1e-16);
  EXPECT_EQ(sine_of_turns(-0.125), -sine_of_turns(0.125));
  EXPECT_NEAR(power(2, 0.5), std::numbers::sqrt2, 1e-15);
  EXPECT_NEAR(decimal_logarithm(1000), 3, 1e-15);
}

}  // namespace
}  // namespace spoolflow::rig
