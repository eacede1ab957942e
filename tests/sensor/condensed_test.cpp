#include "spoolflow/sensor/condensed.hpp"

#include <cmath>
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

TEST(Condensed, NamesTheOtherDirectionInsteadOfASilentZero) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  const auto answer = [&](double current_A, double position_m) {
    return step(valve, state, {1e-3, current_A, 12, position_m, 323});
  };
  EXPECT_FALSE(has(answer(0, -0.02e-3).status, Status::other_direction));
  const double most = answer(3.2, 1.5e-3).flow_m3_per_s;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const double current_A : {0.0, 1.5, nothing}) {
    const Estimate<double> other = answer(current_A, -1.5e-3);
    EXPECT_TRUE(has(other.status, Status::other_direction));
    EXPECT_EQ(has(other.status, Status::sample_missing), std::isnan(current_A));
    EXPECT_EQ(other.flow_m3_per_s, 0);
    EXPECT_NEAR(other.flow_lower_m3_per_s, -most, 0.02 * most);
    EXPECT_NEAR(other.flow_upper_m3_per_s, 0, 0.02 * most);
  }
  EXPECT_FALSE(has(answer(0, -1e9).status, Status::other_direction)) << "no measurement";
}

TEST(Condensed, SaysClosedBelowTheOpening) {
  const auto valve = laid_out(linear_valve());
  CondensedState<double> state;
  EXPECT_EQ(step(valve, state, {1e-3, 0.1, 0, 0.05e-3, 323}).status, Status::closed);
}

/// The linear valve, bent: all maps curved, so that their cells differ.
CondensedParameters<double> curved_valve() {
  CondensedParameters<double> valve = linear_valve();
  for (double& force_N : valve.magnetic_force.map.values) force_N += 0.02 * force_N * force_N;
  for (double& force_N : valve.spring.curve.values) force_N += 5 + 0.05 * force_N * force_N;
  for (int p = 0; p < flow_map_positions; ++p) {
    valve.flow_rate.largest_force_N.values[static_cast<unsigned>(p)] = 1 + p;
    for (int f = 0; f < flow_map_forces; ++f) valve.flow_rate.flow_m3_per_s.node(p, f) *= (1 + 0.01 * f) * p / 48;
  }
  return valve;
}

TEST(CondensedTables, AnswerAsTheCalibratedMapsDo) {
  const auto valve = curved_valve();
  const auto tables = laid_out(valve);
  CondensedState<double> state;
  for (double x = 0.13e-3; x < 2.4e-3; x += 0.11e-3) {
    for (double current_A = 0.9; current_A < 3.2; current_A += 0.17) {
      const auto out = step(tables, state, {1e-3, current_A, 12, x, 323});
      EXPECT_NEAR(out.magnetic_force_N, valve.magnetic_force.at(current_A, x).value, 1e-9);
      EXPECT_NEAR(out.spring_force_N, valve.spring.at(x).value, 0.01);  // its positions lie otherwise
      const auto flow = valve.flow_rate.at(out.flow_force_N, x);
      EXPECT_NEAR(out.flow_m3_per_s, flow.flow_m3_per_s, 2e-6) << x << ' ' << current_A;  // half its cells: 0.2 %
      EXPECT_NEAR(out.pressure_difference_Pa, flow.pressure_difference_Pa, 1);
      EXPECT_EQ(has(out.status, Status::outside_flow_force_map), !flow.inside) << x << ' ' << current_A;
    }
  }
}

TEST(CondensedTables, LaidOutForOnePositionAnswerThereAsTheWholeDoes) {
  const auto valve = curved_valve();
  const auto tables = laid_out(valve);
  for (const double x : {-1e-3, 0.0, 0.3e-3, 1.37e-3, 2.4e-3, 3e-3}) {
    CondensedTables<double> part{};
    lay_out_at(valve, x, part);
    CondensedState<double> one, other;
    const Sample<double> sample{1e-3, 1.7, 12, x, 323};
    EXPECT_EQ(step(part, one, sample).flow_m3_per_s, step(tables, other, sample).flow_m3_per_s) << x;
    EXPECT_EQ(one.last.flow_upper_m3_per_s, other.last.flow_upper_m3_per_s) << x;
    EXPECT_EQ(one.last.status, other.last.status) << x;
  }
}

TEST(Condensed, HoldsItsAnswerForWhatNoInstrumentReads) {
  CondensedTables<float> tables{};
  {
    const auto valve = laid_out(curved_valve());
    tables.cells_per_m = static_cast<float>(valve.cells_per_m);
    tables.cells_per_A = static_cast<float>(valve.cells_per_A);
    for (std::size_t k = 0; k < valve.records.size(); ++k) tables.records[k] = static_cast<float>(valve.records[k]);
  }
  CondensedState<float> state;
  const float flow = step(tables, state, {1e-3F, 1.7F, 12, 1e-3F, 323}).flow_m3_per_s;
  EXPECT_GT(flow, 0);
  const float infinite = std::numeric_limits<float>::infinity();
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  for (const float wild : {infinite, -infinite, nothing, -nothing, 1e30F, -1e30F, 1e9F, -1e9F}) {
    EXPECT_EQ(step(tables, state, {1e-3F, wild, 12, 1e-3F, 323}).status, Status::sample_missing) << wild;
    EXPECT_EQ(step(tables, state, {1e-3F, 1.7F, 12, wild, 323}).status, Status::sample_missing) << wild;
    if (wild != 1e9F) {  // a time step of thirty years is one
      EXPECT_EQ(step(tables, state, {wild, 1.7F, 12, 1e-3F, 323}).status, Status::time_fault) << wild;
    }
    EXPECT_EQ(state.last.flow_m3_per_s, flow) << wild;
  }
  EXPECT_EQ(step(tables, state, {0.0F, -0.0F, 12, -0.0F, 323}).status, Status::outside_flow_force_map);
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
