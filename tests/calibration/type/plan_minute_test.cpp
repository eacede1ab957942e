#include "spoolflow/calibration/type/plan_minute.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/calibration/type/spread.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/calibration/type/virtual_unit.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

model::Model type_with(const recording::CampaignTolerances& tolerances) {
  return type_model(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), tolerances_from(tolerances));
}

TEST(PlanMinute, LeavesLessTheMoreTimeThereIs) {
  const model::Model type = type_with({});
  const PlannedMinute quarter = plan_minute(type, "type.json", 15), minute = plan_minute(type, "type.json", 60);
  EXPECT_LT(quarter.after_share, 0.5 * quarter.before_share);
  EXPECT_LT(minute.after_share, quarter.after_share);
  EXPECT_DOUBLE_EQ(minute.before_share, quarter.before_share);
  EXPECT_LE(minute.corners().back().time_s, 60);
  EXPECT_GT(minute.corners().back().time_s, 40);
}

TEST(PlanMinute, EdgesThatVaryMostAskForPressureAndOpenTheValveUnderIt) {
  recording::CampaignTolerances edges{
      "",
      {{"edge_width", 0.05}, {"flow_force", 0.1}, {"spring_preload", 0.001}, {"permeance", 0.001}, {"turns", 0.0005}}};
  const PlannedMinute minute = plan_minute(type_with(edges), "type.json", 60);
  ASSERT_FALSE(minute.pressures_Pa.empty());
  EXPECT_GT(minute.pressures_Pa.back(), 30e5);  // flow and flow force grow with it, the meter's noise does not
  EXPECT_TRUE(std::ranges::is_sorted(minute.pressures_Pa));
}

TEST(PlanMinute, NoStrokeIsSoFastThatFrictionIsNotThatOfTheMaps) {
  for (const double seconds : {14.0, 60.0, 200.0})
    EXPECT_LE(plan_minute(type_with({}), "type.json", seconds).rate_per_s, 0.16) << seconds;
}

TEST(PlanMinute, ItsCornersAreStrokesFromTheClosedEndAndBackWithoutAJump) {
  const std::vector<PlannedCorner> corners = plan_minute(type_with({}), "type.json", 40).corners();
  EXPECT_EQ(corners.front().time_s, 0);
  EXPECT_EQ(corners.front().position_share, 0);
  EXPECT_EQ(corners.back().position_share, 0);
  for (std::size_t k = 1; k < corners.size(); ++k) {
    EXPECT_GT(corners[k].time_s, corners[k - 1].time_s - 1e-9);
    if (corners[k].pressure_Pa == corners[k - 1].pressure_Pa) continue;
    EXPECT_EQ(corners[k].position_share, 0) << "the pressure changes with the valve closed";
  }
}

TEST(PlanMinute, AUnitThatWasRecordedSoIsKnownAboutAsWellAsPromised) {
  model::Model valve = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  valve.observer->parameters.position_sensor.drift_m_per_K = 0;  // as the virtual unit's
  const model::Model type = type_model(std::move(valve), tolerances_from({}));
  const PlannedMinute minute = plan_minute(type, "type.json", 20);
  std::vector<double> pressures_bar;
  for (const double pressure_Pa : minute.pressures_Pa) pressures_bar.push_back(1e-5 * pressure_Pa);
  const recording::TemporaryFile file("planned.csv");
  write_strokes(file.path(), type.observer->parameters, pressures_bar, type.valve.stroke_m, 1 / minute.rate_per_s);
  const recording::Recording recorded = recording::read_recording(file.path(), {});
  const UnitFit fit =
      most_likely_unit({type, {{&recorded, recording::Protocol::operation}}}, known_of_type(type, "type.json"));
  const UnitSpread promised = spread_of(type.observer->parameters, minute.after),
                   kept = spread_of(type.observer->parameters, fit.known),
                   before = spread_of(type.observer->parameters, known_of_type(type, "type.json"));
  EXPECT_NEAR(kept.force_N / promised.force_N, 1, 0.3);
  EXPECT_NEAR(kept.flow_share / promised.flow_share, 1, 0.3);
  EXPECT_LT(kept.force_N, 0.7 * before.force_N);
  EXPECT_LT(kept.flow_share, 0.7 * before.flow_share);
}

TEST(PlanMinute, NoStrokeFitsIntoTwoSecondsAndAValveIsNoType) {
  EXPECT_THROW((void)plan_minute(type_with({}), "type.json", 2), CalibrationError);
  EXPECT_THROW((void)plan_minute(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), "a.json", 60), CalibrationError);
}

}  // namespace
}  // namespace spoolflow::calibration
