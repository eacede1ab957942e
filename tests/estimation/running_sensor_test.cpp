#include "spoolflow/estimation/running_sensor.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/estimation/straight_valve.hpp"

namespace spoolflow::estimation {
namespace {

using sensor::Status;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

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
