#include "spoolflow/estimation/running_sensor.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace spoolflow::estimation {
namespace {

using sensor::Status;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A straight magnet (10 N/A), no spring, and a flow that rises with the root of the flow force; figures are made up.
sensor::CondensedParameters<double> straight_valve() {
  sensor::CondensedParameters<double> valve{};
  const auto axis = [](double spacing) { return sensor::Axis<double>{0, spacing, 1 / spacing}; };
  auto& force = valve.magnetic_force;
  force.map.row_axis = force.hysteresis_half_width_N.axis = axis(0.1);
  force.map.column_axis = axis(1e-4);
  for (int row = 0; row < force.map.rows; ++row) {
    for (int column = 0; column < force.map.columns; ++column) force.map.node(row, column) = row;
  }
  valve.spring.curve.axis = valve.friction_half_width_N.axis = axis(1e-4);
  auto& flow = valve.flow_rate;
  flow.largest_force_N.axis = flow.flow_m3_per_s.row_axis = flow.root_pressure_difference.row_axis = axis(1e-4);
  flow.flow_m3_per_s.column_axis = flow.root_pressure_difference.column_axis = axis(1.0 / 16);
  flow.largest_force_N.values.fill(40);
  for (int row = 0; row < flow.flow_m3_per_s.rows; ++row) {
    for (int column = 0; column < flow.flow_m3_per_s.columns; ++column)
      flow.flow_m3_per_s.node(row, column) = 1e-4 * column;
  }
  return valve;
}

TEST(RunningSensor, HoldsItsAnswerWhileASampleIsMissingAndRecovers) {
  const auto valve = straight_valve();
  RunningSensor sensor(&valve, 1e-3);
  const auto good = sensor.step({0.0, 1.0, nothing, 1e-3, nothing});
  EXPECT_FALSE(has(good.status, Status::sample_missing));
  for (const double bad : {nothing, std::numeric_limits<double>::infinity(), -1e300}) {
    const auto held = sensor.step({0.001, bad, nothing, 1e-3, nothing});
    EXPECT_TRUE(has(held.status, Status::sample_missing)) << bad;
    EXPECT_EQ(held.flow_m3_per_s, good.flow_m3_per_s) << bad;
  }
  EXPECT_EQ(sensor.step({0.002, 1.0, nothing, 1e-3, nothing}).status, good.status);
}

TEST(RunningSensor, KnowsNothingButTheRatedFlowBeforeItsFirstCompleteSample) {
  const auto valve = straight_valve();
  RunningSensor sensor(&valve, 1e-3);
  const auto first = sensor.step({0.0, nothing, nothing, 1e-3, nothing});
  EXPECT_EQ(first.flow_m3_per_s, 0.0);
  EXPECT_EQ(first.flow_upper_m3_per_s, 1e-3);
}

TEST(RunningSensor, ReportsATimeThatStandsStillOrRunsBackwardsAndGoesOnFromThere) {
  const auto valve = straight_valve();
  RunningSensor sensor(&valve, 1e-3);
  const auto first = sensor.step({10.0, 1.0, nothing, 1e-3, nothing});
  EXPECT_FALSE(has(first.status, Status::time_fault));  // the first time is any time
  EXPECT_TRUE(has(sensor.step({10.0, 2.0, nothing, 1e-3, nothing}).status, Status::time_fault));
  const auto second_look = sensor.step({10.0, 1.5, nothing, 1e-3, nothing});
  const auto back = sensor.step({9.0, 0.5, nothing, 1e-3, nothing});
  EXPECT_TRUE(has(back.status, Status::time_fault));
  EXPECT_EQ(back.flow_m3_per_s, second_look.flow_m3_per_s);
  EXPECT_TRUE(has(sensor.step({nothing, 0.5, nothing, 1e-3, nothing}).status, Status::time_fault));
  const auto after = sensor.step({9.001, 1.0, nothing, 1e-3, nothing});
  EXPECT_EQ(after.status, first.status);
  EXPECT_EQ(after.flow_m3_per_s, first.flow_m3_per_s);
}

TEST(RunningSensor, IsAsNewAfterAResetAndGoesOnFromARestoredState) {
  const auto valve = straight_valve();
  RunningSensor sensor(&valve, 1e-3);
  (void)sensor.step({0.0, 1.0, nothing, 1e-3, nothing});
  const RunningState kept = sensor.state();
  const auto held = sensor.step({0.001, nothing, nothing, 1e-3, nothing});
  sensor.reset();
  EXPECT_EQ(sensor.step({0.0, nothing, nothing, 1e-3, nothing}).flow_m3_per_s, 0.0);
  sensor.set_state(kept);
  EXPECT_EQ(sensor.step({0.001, nothing, nothing, 1e-3, nothing}).flow_m3_per_s, held.flow_m3_per_s);
}

}  // namespace
}  // namespace spoolflow::estimation
