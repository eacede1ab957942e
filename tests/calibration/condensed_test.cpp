#include "spoolflow/calibration/condensed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/edges/flow_rate_fit.hpp"
#include "spoolflow/calibration/edges/uniqueness.hpp"
#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/calibration/fits/magnetic_force_fit.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "synthetic_bench.hpp"

namespace spoolflow::calibration {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Property;

const std::vector<Stroke> pressures{{5e5}, {10e5}, {20e5}, {30e5}, {40e5}, {50e5}, {60e5}, {70e5}};
const std::vector<Stroke> currents{{0.4}, {0.8}, {1.2}, {1.6}, {2.0}, {2.4}};

TEST(Spring, IsFreeOfFrictionWhateverTheSpeedsHoldsAndNoise) {
  const auto recording = axial_force_recording({{.opening_speed = 120e-6, .closing_speed = 400e-6, .hold_samples = 700},
                                                {.opening_speed = 60e-6, .closing_speed = 90e-6, .hold_samples = 3}},
                                               3e-6);
  const SpringFit fit = fit_spring(recording, bench_stroke_m);
  for (double x = 0; x <= bench_stroke_m; x += 0.1e-3) {
    EXPECT_NEAR(fit.spring.at(x).value, spring_N(x), 0.03) << x;  // 3 um of position noise are 0.04 N a sample
  }
  EXPECT_NEAR(fit.friction_half_width_N[10], 2.0, 0.03);
  EXPECT_LT(fit.residual.rms(), 0.06);
}

TEST(Spring, WithOneDirectionOnlyIsRefusedWithTheDirectionThatIsMissing) {
  const auto recording = axial_force_recording({{.with_closing = false}}, 0);
  EXPECT_THAT(
      [&] { (void)fit_spring(recording, bench_stroke_m); },
      ::testing::ThrowsMessage<CalibrationError>(AllOf(HasSubstr("axial.csv"), HasSubstr("no closing stroke"))));
}

TEST(MagneticForce, FollowsTheHeldCurrentsInAnyOrderWithSeveralStrokesALevel) {
  std::vector<Stroke> shuffled{{2.4}, {0.8}, {0.4}, {2.0}, {0.8, 200e-6, 70e-6}, {1.6}, {1.2}};
  for (Stroke& stroke : shuffled) stroke.to_m = 2.5e-3;
  const MagneticForceFit fit = fit_magnetic_force(solenoid_recording(shuffled, 2e-6), bench_stroke_m);
  ASSERT_EQ(fit.loops.size(), 6U);
  for (const double i : {0.4, 0.8, 1.2, 1.6, 2.0, 2.4}) {
    for (double x = 0; x <= bench_stroke_m; x += 0.3e-3) {
      EXPECT_NEAR(fit.magnetic_force.at(i, x).value, magnetic_N(i, x), 0.12) << i << " A, " << x << " m";
    }
  }
  EXPECT_NEAR(fit.magnetic_force.at(1.0, 1e-3).value, magnetic_N(1.0, 1e-3), 0.4);  // between the levels
  EXPECT_NEAR(fit.magnetic_force.hysteresis_half_width_N.at(2.0).value, 1.3, 0.05);
  EXPECT_EQ(fit.magnetic_force.at(0.0, 1e-3).value, 0);
}

TEST(MagneticForce, NamesTheCurrentAtWhichADirectionIsMissing) {
  std::vector<Stroke> strokes = currents;
  strokes[2].with_closing = false;
  strokes[3].from_m = bench_stroke_m - 1e-6;  // the next level begins open and closes
  strokes[3].opening_speed = 1;
  EXPECT_THAT([&] { (void)fit_magnetic_force(solenoid_recording(strokes, 0), bench_stroke_m); },
              ::testing::ThrowsMessage<CalibrationError>(
                  AllOf(HasSubstr("coil current 1.2 A"), HasSubstr("no closing stroke"))));
}

TEST(MagneticForce, NamesTheGapWhereALevelIsAbsentFromAnEvenRow) {
  std::vector<Stroke> strokes = currents;
  strokes.erase(strokes.begin() + 2);
  EXPECT_THAT(
      [&] { (void)fit_magnetic_force(solenoid_recording(strokes, 0), bench_stroke_m); },
      ::testing::ThrowsMessage<CalibrationError>(AllOf(HasSubstr("0.8 A"), HasSubstr("1.6 A"), HasSubstr("absent"))));
}

TEST(AxialForce, NamesThePositionsThatALevelDoesNotCover) {
  std::vector<Stroke> strokes = pressures;
  strokes[4].to_m = 1.8e-3;
  EXPECT_THAT(
      [&] { (void)fit_axial_force(axial_force_recording(strokes, 0), bench_stroke_m); },
      ::testing::ThrowsMessage<CalibrationError>(AllOf(HasSubstr("40 bar"), HasSubstr("to 2.400 mm are not covered"))));
}

TEST(FlowRate, InvertsTheFlowForceMapItWasMadeFrom) {
  const SpringFit spring = fit_spring(axial_force_recording({{}}, 0), bench_stroke_m);
  const AxialForceFit axial = fit_axial_force(axial_force_recording(pressures, 1e-6), bench_stroke_m);
  const auto columns = flow_force_columns(axial.loops, spring.spring);
  const sensor::FlowRate<double> flow_rate = invert_flow_force(columns, 0.05);
  for (double x = 0.4e-3; x <= bench_stroke_m; x += 0.25e-3) {
    for (const double p : {7e5, 15e5, 33e5, 66e5}) {
      const auto found = flow_rate.at(flow_force_N(x, p), x);
      EXPECT_NEAR(found.flow_m3_per_s, flow_m3_per_s(x, p), 0.01 * flow_m3_per_s(bench_stroke_m, 70e5))
          << x << " m, " << p << " Pa";
      EXPECT_NEAR(found.pressure_difference_Pa, p, 0.04 * p + 1e4);
      EXPECT_TRUE(found.inside);
    }
  }
  EXPECT_FALSE(flow_rate.at(1000, 1e-3).inside);
  EXPECT_NEAR(flow_rate.at(1000, 1e-3).flow_m3_per_s, flow_m3_per_s(1e-3, 70e5), 1e-5);
}

TEST(Uniqueness, IsBlindOnlyBelowTheOpening) {
  const SpringFit spring = fit_spring(axial_force_recording({{}}, 0), bench_stroke_m);
  const AxialForceFit axial = fit_axial_force(axial_force_recording(pressures, 0), bench_stroke_m);
  const model::Uniqueness found = check_uniqueness(flow_force_columns(axial.loops, spring.spring), 0.1);
  EXPECT_NEAR(found.blind_below_m, 0.2e-3, 0.06e-3);
  EXPECT_TRUE(found.ambiguous_at_m.empty());
}

TEST(Uniqueness, ListsThePositionsAtWhichAHigherLevelPullsLess) {
  std::vector<FlowForceColumn> columns;
  for (int k = 0; k < 5; ++k) columns.push_back({k * 1e-3, {1.0, 2.0, k == 3 ? 1.5 : 3.0}, {1, 2, 3}, {1e5, 2e5, 3e5}});
  const model::Uniqueness found = check_uniqueness(columns, 0.1);
  EXPECT_THAT(found.ambiguous_at_m, ::testing::ElementsAre(3e-3));
  EXPECT_NEAR(found.unique_from_m, 4e-3, 1e-9);
}

TEST(Condensed, RecoversTheFlowOfAValveWithoutFrictionFromCurrentAndPosition) {
  const auto spring = axial_force_recording({{}}, 1e-6);
  std::vector<Stroke> strokes = currents;
  for (Stroke& stroke : strokes) stroke.to_m = 2.5e-3;
  const auto solenoid = solenoid_recording(strokes, 1e-6);
  const auto axial = axial_force_recording(pressures, 1e-6);
  AxialForceMaps maps;
  maps.joined = {&axial};
  const auto found =
      calibrate_condensed({spring, solenoid, {}, maps}, {"synthetic", 80 / 60000.0, bench_stroke_m, "b"});
  const auto tables = sensor::laid_out(found.condensed.parameters);
  sensor::CondensedState<double> state;
  for (double x = 0.5e-3; x < 2.3e-3; x += 0.2e-3) {
    const double p = 45e5;
    const double force_N = spring_N(x) + flow_force_N(x, p);
    const double current_A = std::sqrt(force_N / magnetic_N(1, x));
    const auto estimate = step(tables, state, {1e-3, current_A, 0, x, 323.15});
    EXPECT_NEAR(estimate.flow_m3_per_s, flow_m3_per_s(x, p), 0.02 * 80 / 60000.0) << x;
    EXPECT_LT(estimate.flow_lower_m3_per_s, flow_m3_per_s(x, p));
    EXPECT_GT(estimate.flow_upper_m3_per_s, flow_m3_per_s(x, p));
    EXPECT_EQ(estimate.status, sensor::Status::none);
  }
  EXPECT_NEAR(found.condensed.parameters.closed_below_m, 0.2e-3, 0.06e-3);
}

}  // namespace
}  // namespace spoolflow::calibration
