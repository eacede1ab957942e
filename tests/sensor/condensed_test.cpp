#include "spoolflow/sensor/condensed.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/sensor/linear_valve.hpp"

namespace spoolflow::sensor {
namespace {

TEST(Condensed, BalancesMagneticForceAgainstSpringAndFlowForce) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  const auto out = step(valve, state, {1e-3, 1.5, 12, 1e-3, 323});
  EXPECT_NEAR(out.magnetic_force_N, 30, 1e-9);
  EXPECT_NEAR(out.spring_force_N, 10, 1e-9);
  EXPECT_NEAR(out.flow_force_N, 20, 1e-9);
  EXPECT_NEAR(out.flow_m3_per_s, 1e-3 * std::sqrt(20.0 / 50), 1e-9);
  EXPECT_NEAR(out.pressure_difference_Pa, 70e5 * 20 / 50, 1);
  EXPECT_EQ(out.status, Status::none);
}

TEST(Condensed, WidensItsBandWhereTheForceCurveIsFlat) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  const auto steep = step(valve, state, {1e-3, 2.8, 12, 1e-3, 323});  // 46 N: dQ/dF small
  const auto flat = step(valve, state, {1e-3, 0.65, 12, 1e-3, 323});  // 3 N: dQ/dF large
  EXPECT_GT(flat.flow_upper_m3_per_s - flat.flow_lower_m3_per_s,
            2 * (steep.flow_upper_m3_per_s - steep.flow_lower_m3_per_s));
}

TEST(Condensed, AnswersAtTheEdgeAndSaysSo) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  const auto strong = step(valve, state, {1e-3, 3.2, 12, 0.2e-3, 323});
  EXPECT_NEAR(strong.flow_m3_per_s, 1e-3, 1e-12);
  EXPECT_TRUE(has(strong.status, Status::outside_flow_force_map));
  const auto weak = step(valve, state, {1e-3, 0.1, 12, 2e-3, 323});
  EXPECT_NEAR(weak.flow_m3_per_s, 0, 1e-18);
  EXPECT_TRUE(has(weak.status, Status::outside_flow_force_map));
  EXPECT_TRUE(has(step(valve, state, {1e-3, 3.3, 12, 1e-3, 323}).status, Status::outside_force_map));
  EXPECT_TRUE(has(step(valve, state, {1e-3, 1.5, 12, 2.6e-3, 323}).status, Status::outside_force_map));
}

TEST(Condensed, HoldsItsLastAnswerWhereASampleIsMissing) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  const auto before = step(valve, state, {1e-3, 1.5, 12, 1e-3, 323});
  const auto missing = step(valve, state, {1e-3, std::numeric_limits<double>::quiet_NaN(), 12, 1e-3, 323});
  EXPECT_EQ(missing.flow_m3_per_s, before.flow_m3_per_s);
  EXPECT_EQ(missing.status, Status::sample_missing);
}

TEST(Condensed, SaysClosedBelowTheOpening) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  EXPECT_EQ(step(valve, state, {1e-3, 0.1, 0, 0.05e-3, 323}).status, Status::closed);
}

TEST(Table, AnswersAtTheEdgeWithTheOutermostSlopeAndNeverIndexesWithNaN) {
  Curve<double, 3> curve{{1.0, 0.5, 2.0}, {0.0, 1.0, 4.0}};
  EXPECT_DOUBLE_EQ(curve.at(1.25).value, 0.5);
  EXPECT_DOUBLE_EQ(curve.at(1.75).slope, 6.0);
  EXPECT_DOUBLE_EQ(curve.at(2.0).value, 4.0);
  EXPECT_TRUE(curve.at(2.0).inside);
  EXPECT_DOUBLE_EQ(curve.at(9.0).value, 4.0);
  EXPECT_FALSE(curve.at(9.0).inside);
  EXPECT_DOUBLE_EQ(curve.at(-9.0).value, 0.0);
  const auto nothing = curve.at(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(nothing.inside);
  EXPECT_DOUBLE_EQ(nothing.value, 0.0);
}

TEST(Table, InterpolatesAPlaneExactly) {
  Map<double, 4, 5> plane{{0.0, 1.0, 1.0}, {2.0, 0.5, 2.0}, {}};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 5; ++c) plane.node(r, c) = 3 * plane.row_axis.at(r) - 2 * plane.column_axis.at(c);
  }
  for (double r = 0; r <= 3; r += 0.37) {
    for (double c = 2; c <= 4; c += 0.23) {
      const auto point = plane.at(r, c);
      EXPECT_NEAR(point.value, 3 * r - 2 * c, 1e-12);
      EXPECT_NEAR(point.row_slope, 3, 1e-12);
      EXPECT_NEAR(point.column_slope, -2, 1e-12);
      EXPECT_TRUE(point.inside);
    }
  }
}

}  // namespace
}  // namespace spoolflow::sensor
