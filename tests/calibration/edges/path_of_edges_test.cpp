#include "spoolflow/calibration/edges/path_of_edges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/edges/metering_edge_fit.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/sensor/band.hpp"
#include "tests/calibration/closed_form_edges.hpp"

namespace spoolflow::calibration {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

SpringFit unloaded_spring() {
  return fit_spring(axial_force_recording({{}}, 0), bench_stroke_m);
}

/// The sensor's maps of a path whose edges were measured one at a time.
MeteringEdgeFit one_edge_at_a_time(const ClosedFormEdge& inlet, const ClosedFormEdge& outlet, double k) {
  const recording::Recording of_inlet = recorded("PB.csv", inlet), of_outlet = recorded("AT.csv", outlet);
  AxialForceMaps maps;
  maps.inlet = {&of_inlet};
  maps.outlet = {&of_outlet};
  maps.outlet_flow_ratio = k;
  const SpringFit spring = unloaded_spring();
  return fit_metering_edge(fit_path(maps, spring.spring, bench_stroke_m).path, spring.spring,
                           spring.friction_half_width_N);
}

AxialForceMaps joined_maps(const recording::Recording& recording, double k) {
  AxialForceMaps maps;
  maps.joined = {&recording};
  maps.outlet_flow_ratio = k;
  return maps;
}

MeteringEdgeFit joined(const recording::Recording& recording, double k) {
  const SpringFit spring = unloaded_spring();
  return fit_metering_edge(fit_path(joined_maps(recording, k), spring.spring, bench_stroke_m).path, spring.spring,
                           spring.friction_half_width_N);
}

TEST(PathOfEdges, MeasuredOneEdgeAtATimeHasTheMapsThatItHasWithBothJoined) {
  const recording::Recording both =
      recorded("joined.csv", [](double x_m, double p_Pa) { return reading_of(wide, narrow, 1, x_m, p_Pa); });
  const MeteringEdgeFit together = joined(both, 1), apart = one_edge_at_a_time(wide, narrow, 1);
  for (const double p_Pa : {10e5, 25e5, 50e5, 68e5}) {
    for (double x_m = 0.4e-3; x_m < 2.4e-3; x_m += 0.2e-3) {
      const auto known = together.edge.at(warm_K, p_Pa, x_m), found = apart.edge.at(warm_K, p_Pa, x_m);
      EXPECT_NEAR(found.conductance / known.conductance, 1, 2e-3) << p_Pa << " Pa, " << x_m << " m";
      EXPECT_NEAR(found.flow_force_N, known.flow_force_N, 0.02) << p_Pa << " Pa, " << x_m << " m";
      EXPECT_NEAR(found.friction_N, known.friction_N, 0.02) << p_Pa << " Pa, " << x_m << " m";
    }
  }
}

TEST(PathOfEdges, SharesThePressureDifferenceAsTheCylinderPassesTheFlow) {
  for (const double k : {0.6, 1 / 0.6}) {
    const MeteringEdgeFit fit = one_edge_at_a_time(wide, narrow, k);
    for (const double p_Pa : {20e5, 60e5}) {
      for (double x_m = 0.4e-3; x_m < 2.4e-3; x_m += 0.4e-3) {
        const EdgeReading known = reading_of(wide, narrow, k, x_m, p_Pa);
        const auto found = fit.edge.at(warm_K, p_Pa, x_m);
        EXPECT_NEAR(found.conductance * std::sqrt(p_Pa) / known.flow_m3_per_s, 1, 2e-3) << k << ", " << x_m << " m";
        EXPECT_NEAR(found.flow_force_N, known.force_N, 0.02) << k << ", " << x_m << " m";
        EXPECT_NEAR(found.friction_N, known.friction_N, 0.02) << k << ", " << x_m << " m";
      }
    }
  }
}

TEST(PathOfEdges, ShowsWhatOfThePressureDifferenceLiesOverTheInlet) {
  const recording::Recording of_inlet = recorded("PB.csv", wide), of_outlet = recorded("AT.csv", narrow);
  const SpringFit spring = unloaded_spring();
  for (const double k : {0.6, 1.0}) {
    AxialForceMaps maps;
    maps.inlet = {&of_inlet};
    maps.outlet = {&of_outlet};
    maps.outlet_flow_ratio = k;
    const sensor::InletShare<double> apart = fit_path(maps, spring.spring, bench_stroke_m).inlet;
    EXPECT_NEAR(apart.share, 0.36 / (0.36 + k * k), 1e-3) << k;  // the outlet's conductance is 0.6 of the inlet's
    EXPECT_NEAR(apart.range, 0.02, 1e-9) << k;
    // Joined, only operation shows the ratio.
    const sensor::InletShare<double> assumed = fit_path(joined_maps(of_inlet, k), spring.spring, bench_stroke_m).inlet;
    EXPECT_EQ(assumed.share, 0.5) << k;
    EXPECT_EQ(assumed.range, 0.25) << k;
  }
  AxialForceMaps maps = joined_maps(of_inlet, 0.6);
  maps.edge_ratio = EdgeRatio{0.6, 0.5, 0.7};
  const sensor::InletShare<double> inlet = fit_path(maps, spring.spring, bench_stroke_m).inlet;
  EXPECT_NEAR(inlet.share, 0.5, 1e-9);
  EXPECT_NEAR(inlet.range, 0.5 - 0.25 / (0.25 + 0.36), 1e-9);
}

TEST(PathOfEdges, ReachesAsFarAsBothEdgesWereMeasured) {
  EXPECT_NEAR(one_edge_at_a_time(wide, wide, 1).edge.highest_pressure_difference_Pa(), 140e5, 0.1e5);
  // Nine times the pressure difference over the outlet: the inlet has little of it.
  EXPECT_NEAR(one_edge_at_a_time(wide, wide, 3).edge.highest_pressure_difference_Pa(), 70e5 / 0.9, 0.5e5);
}

TEST(PathOfEdges, IsClosedUntilBothEdgesAreOpenAndThenPullsWithTheOneThatHoldsThePressure) {
  const ClosedFormEdge early{.opens_at_m = 0.2e-3}, late{.opens_at_m = 0.5e-3};
  const MeteringEdgeFit fit = one_edge_at_a_time(late, early, 1);
  const auto closed = fit.edge.at(warm_K, 40e5, 0.4e-3);
  EXPECT_NEAR(closed.conductance, 0, 1e-9);
  EXPECT_NEAR(closed.flow_force_N, 0, 0.05);  // the closed inlet holds all of it, and no oil flows
  const EdgeReading open = reading_of(late, early, 1, 0.6e-3, 40e5);
  EXPECT_NEAR(fit.edge.at(warm_K, 40e5, 0.6e-3).flow_force_N, open.force_N, 0.1);
}

TEST(PathOfEdges, OfLikeEdgesJoinedOnTheBenchIsThatUnderTheCylinder) {
  const recording::Recording both =
      recorded("joined.csv", [](double x_m, double p_Pa) { return reading_of(wide, wide, 1, x_m, p_Pa); });
  for (const double k : {0.6, 1 / 0.6}) {
    const MeteringEdgeFit fit = joined(both, k);
    for (double x_m = 0.4e-3; x_m < 2.4e-3; x_m += 0.4e-3) {
      const EdgeReading known = reading_of(wide, wide, k, x_m, 50e5);
      const auto found = fit.edge.at(warm_K, 50e5, x_m);
      EXPECT_NEAR(found.conductance * std::sqrt(50e5) / known.flow_m3_per_s, 1, 2e-3) << k << ", " << x_m << " m";
      EXPECT_NEAR(found.flow_force_N, known.force_N, 0.02) << k << ", " << x_m << " m";
    }
  }
  // A return behind the smaller area lifts the path above what the supply holds.
  EXPECT_NEAR(joined(both, 0.6).edge.highest_pressure_difference_Pa(), 70e5 * 1.25, 0.1e5);
  EXPECT_NEAR(joined(both, 1 / 0.6).edge.highest_pressure_difference_Pa(), 70e5, 0.1e5);
}

TEST(PathOfEdges, WhoseEdgesAreAssumedHasABandThatHoldsEdgesCutForTheCylinder) {
  for (const double k : {0.4, 0.6, 1 / 0.6}) {
    ClosedFormEdge cut = wide;
    cut.conductance_per_m *= k;
    cut.force_per_m_Pa *= k;
    const recording::Recording both =
        recorded("joined.csv", [&](double x_m, double p_Pa) { return reading_of(wide, cut, 1, x_m, p_Pa); });
    const MeteringEdgeFit fit = joined(both, k);
    const double x_m = 1.6e-3;
    const EdgeReading known = reading_of(wide, cut, k, x_m, 30e5);
    // The sensor reads the flow force, and the flow from it.
    const auto point = fit.edge.at(warm_K, 30e5, x_m);
    const double estimated_Pa = 30e5 * known.force_N / point.flow_force_N;
    const double estimated_m3_per_s = point.conductance * std::sqrt(estimated_Pa);
    const double residual_m3_per_s = flow_residual_with_unknown_edges(joined_maps(both, k), 0, known.flow_m3_per_s);
    const double missed_m3_per_s = std::abs(estimated_m3_per_s - known.flow_m3_per_s);
    EXPECT_LT(missed_m3_per_s, 1.02 * sensor::flow_residual_factor * residual_m3_per_s) << k;
    EXPECT_GT(missed_m3_per_s, 0.5 * sensor::flow_residual_factor * residual_m3_per_s) << k;
  }
}

TEST(PathOfEdges, WhoseProportionOperationShowedIsThatUnderTheCylinder) {
  ClosedFormEdge cut = wide;
  cut.conductance_per_m *= 0.5;
  cut.force_per_m_Pa *= 0.5;
  const recording::Recording both =
      recorded("joined.csv", [&](double x_m, double p_Pa) { return reading_of(wide, cut, 1, x_m, p_Pa); });
  AxialForceMaps maps = joined_maps(both, 0.6);
  maps.edge_ratio = EdgeRatio{0.5, 0.48, 0.52};
  const SpringFit spring = unloaded_spring();
  const MeteringEdgeFit fit = fit_metering_edge(fit_path(maps, spring.spring, bench_stroke_m).path, spring.spring,
                                                spring.friction_half_width_N);
  const EdgeReading known = reading_of(wide, cut, 0.6, 1.6e-3, 50e5);
  const auto found = fit.edge.at(warm_K, 50e5, 1.6e-3);
  EXPECT_NEAR(found.conductance * std::sqrt(50e5) / known.flow_m3_per_s, 1, 2e-3);
  EXPECT_NEAR(found.flow_force_N, known.force_N, 0.02);
  const double measured_m3_per_s = flow_residual_with_unknown_edges(maps, 0, 1e-3);
  maps.edge_ratio.reset();
  EXPECT_LT(measured_m3_per_s, 0.2 * flow_residual_with_unknown_edges(maps, 0, 1e-3));
  EXPECT_NEAR(edge_ratio_of(0.6, conductance_under_load(0.6, 0.5)), 0.5, 1e-12);
}

TEST(PathOfEdges, WidensNoBandWhereTheCampaignShowsTheEdges) {
  const recording::Recording one = recorded("one.csv", wide);
  EXPECT_EQ(flow_residual_with_unknown_edges(joined_maps(one, 1), 1e-6, 1e-3), 1e-6);
  AxialForceMaps apart;
  apart.inlet = apart.outlet = {&one};
  apart.outlet_flow_ratio = 0.6;
  EXPECT_EQ(flow_residual_with_unknown_edges(apart, 1e-6, 1e-3), 1e-6);
}

TEST(PathOfEdges, IsRefusedWithTheFileWhoseOilTemperatureTheOtherEdgeLacks) {
  const recording::Recording cold = recorded("PB_30.csv", wide, 303.15), warm = recorded("PB_50.csv", wide),
                             other = recorded("AT_50.csv", narrow, warm_K + 3);
  AxialForceMaps maps;
  maps.inlet = {&warm, &cold};
  maps.outlet = {&other};
  const SpringFit spring = unloaded_spring();
  EXPECT_THAT([&] { (void)fit_path(maps, spring.spring, bench_stroke_m); },
              ThrowsMessage<CalibrationError>(
                  AllOf(HasSubstr("PB_30.csv: edge measured at 30.0 degC"), HasSubstr("AT_50.csv at 53.0 degC"))));
  maps.inlet = {&warm};
  const PathFit fit = fit_path(maps, spring.spring, bench_stroke_m);
  ASSERT_EQ(fit.path.size(), 1U);
  EXPECT_NEAR(fit.path.front().oil_temperature_K, warm_K + 1.5, 1e-6);
}

TEST(PathOfEdges, WhoseMeterWasTurnedRoundWithTheHosesIsRefusedByFile) {
  const recording::Recording of_inlet = recorded("PB.csv", wide);
  recording::Recording of_outlet = recorded("AT.csv", narrow);
  for (double& flow : of_outlet.column(recording::Channel::flow)) flow = -flow;
  AxialForceMaps maps;
  maps.inlet = {&of_inlet};
  maps.outlet = {&of_outlet};
  const SpringFit spring = unloaded_spring();
  EXPECT_THAT([&] { (void)fit_path(maps, spring.spring, bench_stroke_m); },
              ThrowsMessage<CalibrationError>(
                  AllOf(HasSubstr("AT.csv: -52.39 L/min"), HasSubstr("flow through the measured edge is > 0"))));
}

}  // namespace
}  // namespace spoolflow::calibration
