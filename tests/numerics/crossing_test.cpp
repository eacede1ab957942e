#include "spoolflow/numerics/crossing.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::numerics {
namespace {

TEST(Crossing, IsTheInverseOfARisingFunctionToWithinRounding) {
  const auto cube = [](double x) { return x * x * x; };
  for (const double x : {1e-3, 0.1, 1.0, 2.5}) EXPECT_NEAR(crossing({0, 3}, cube(x), cube) / x, 1, 1e-14) << x;
}

TEST(Crossing, AnswersWithAnEndWhereTheValueIsNotReached) {
  const auto line = [](double x) { return x; };
  EXPECT_NEAR(crossing({1, 2}, 0.5, line), 1, 1e-15);
  EXPECT_NEAR(crossing({1, 2}, 7.0, line), 2, 1e-15);
}

TEST(Crossing, OfAStepLiesAtTheStep) {
  EXPECT_NEAR(crossing({0, 1}, 0.5, [](double x) { return x < 0.3 ? 0.0 : 1.0; }), 0.3, 1e-15);
}

}  // namespace
}  // namespace spoolflow::numerics
