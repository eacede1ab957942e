#include "addons/fleet/page/series_spread.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace spoolflow::fleet {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// 1 to 9, each known as well as stated.
std::vector<ValveFigure> series(double uncertainty_95) {
  std::vector<ValveFigure> out;
  for (int k = 1; k <= 9; ++k) out.push_back({static_cast<double>(k), uncertainty_95});
  return out;
}

TEST(SeriesSpread, MedianAndDeviationAreNotMovedByOneWildValve) {
  std::vector<ValveFigure> values = series(0.1);
  const SeriesSpread before = spread_of(values);
  EXPECT_EQ(before.median, 5);
  EXPECT_DOUBLE_EQ(before.scale, 1.4826 * 2);
  values.back().value = 1e9;
  values.push_back({unknown, unknown});
  const SeriesSpread after = spread_of(values);
  EXPECT_EQ(after.median, 5);
  EXPECT_DOUBLE_EQ(after.scale, 1.4826 * 2);
  EXPECT_EQ(after.valves, 9U);
  EXPECT_TRUE(is_outlier(after, {1e9, 0.1}));
  EXPECT_FALSE(is_outlier(after, {15, 0.1}));
  EXPECT_TRUE(is_outlier(after, {16, 0.1}));
  EXPECT_TRUE(is_outlier(after, {-6, 0.1}));
  EXPECT_FALSE(is_outlier(after, {unknown, 0.1}));
}

TEST(SeriesSpread, NoneIsNamedWhereItsValueIsUncertain) {
  const SeriesSpread rough = spread_of(series(19.6));
  EXPECT_DOUBLE_EQ(rough.scale, 10);  // valves differ by no more than their uncertainty
  EXPECT_FALSE(is_outlier(rough, {16, 19.6}));
  EXPECT_FALSE(is_outlier(spread_of(series(0.1)), {16, 12}));
}

TEST(SeriesSpread, EqualValvesAndFewOnesNameNone) {
  const SeriesSpread equal = spread_of(std::vector<ValveFigure>(9, {3, 0}));
  EXPECT_EQ(equal.scale, 0);
  EXPECT_EQ(score(equal, {4, 0}), 0);
  EXPECT_FALSE(is_outlier(equal, {4, 0}));
  const SeriesSpread few = spread_of({{1, 0}, {2, 0}, {3, 0}, {100, 0}});
  EXPECT_FALSE(is_outlier(few, {100, 0}));
  EXPECT_TRUE(std::isnan(spread_of({}).median));
}

}  // namespace
}  // namespace spoolflow::fleet
