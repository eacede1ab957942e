/// Flow force, friction and conductance of an edge whose laws are known.
#include "spoolflow/sensor/metering_edge.hpp"

#include <gtest/gtest.h>

#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::sensor {
namespace {

TEST(MeteringEdge, AnswersBetweenItsGridPointsByTheLawsThatItHolds) {
  const MeteringEdge<double> edge = closed_form_edge<double>(closed_form);
  for (const double x : {0.31e-3, 0.777e-3, 1.5e-3, 2.33e-3}) {
    for (const double pressure_Pa : {3e5, 41e5, 88e5}) {
      for (const double temperature_K : {304.0, 322.0, 341.0}) {
        const EdgePoint<double> point = edge.at(temperature_K, pressure_Pa, x);
        EXPECT_NEAR(point.flow_force_N, ClosedFormValve::flow_force_N(x, pressure_Pa), 1e-9);
        EXPECT_NEAR(point.flow_force_per_pressure_N_Pa, ClosedFormValve::flow_force_per_pressure(x), 1e-12);
        EXPECT_NEAR(point.friction_N, ClosedFormValve::spool_friction_N(pressure_Pa, temperature_K), 1e-9);
        EXPECT_NEAR(point.friction_per_pressure_N_Pa, 2e-7 * (1 - 0.1 * (temperature_K - 303) / 40), 1e-12);
        EXPECT_NEAR(point.conductance * std::sqrt(pressure_Pa),
                    closed_form.flow_m3_per_s(x, pressure_Pa, temperature_K), 1e-12);
        EXPECT_TRUE(point.inside && point.temperature_inside);
      }
    }
  }
}

TEST(MeteringEdge, SaysWhatItWasNotMeasuredAt) {
  const MeteringEdge<double> edge = closed_form_edge<double>(closed_form);
  EXPECT_FALSE(edge.at(290.0, 40e5, 1e-3).temperature_inside);
  EXPECT_FALSE(edge.at(350.0, 40e5, 1e-3).temperature_inside);
  EXPECT_FALSE(edge.at(313.0, 110e5, 1e-3).inside);
  EXPECT_FALSE(edge.at(313.0, 40e5, 2.6e-3).inside);
}

TEST(MeteringEdge, GoesOnAboveTheHighestPressureByPhysics) {
  const MeteringEdge<double> edge = closed_form_edge<double>(closed_form);
  const EdgePoint<double> beyond = edge.at(313.0, 110e5, 1e-3);
  EXPECT_NEAR(beyond.flow_force_N, ClosedFormValve::flow_force_N(1e-3, 110e5), 1e-9);
  EXPECT_NEAR(beyond.flow_force_per_pressure_N_Pa, ClosedFormValve::flow_force_per_pressure(1e-3), 1e-12);
  EXPECT_NEAR(beyond.friction_N, ClosedFormValve::spool_friction_N(110e5, 313), 1e-9);
  EXPECT_NEAR(beyond.conductance, closed_form.conductance(1e-3, 313), 1e-15);
}

TEST(MeteringEdge, GoesOnInColderAndWarmerOilByViscosity) {
  MeteringEdge<double> edge = closed_form_edge<double>(closed_form);
  const auto conductance_at = [](double temperature_K) { return 1e-7 - 2e-6 / (temperature_K - viscosity_origin_K); };
  for (int layer = 0; layer < edge_temperatures; ++layer) {
    for (int row = 0; row < edge_pressures; ++row) {
      for (int column = 0; column < edge_positions; ++column)
        edge.conductance.node(layer, row, column) = conductance_at(edge.temperature_K.at(layer));
    }
  }
  for (const double temperature_K : {263.0, 283.0, 353.0, 363.0})
    EXPECT_NEAR(edge.at(temperature_K, 40e5, 1e-3).conductance, conductance_at(temperature_K), 1e-15) << temperature_K;
}

TEST(MeteringEdge, NeverDividesByASlopeOfNothing) {
  // Covered edges carry no flow force at any pressure: the slope is zero there, and forces are divided by it.
  const EdgePoint<double> closed = closed_form_edge<double>(closed_form).at(313.0, 40e5, 0.1e-3);
  EXPECT_DOUBLE_EQ(closed.flow_force_N, 0);
  EXPECT_DOUBLE_EQ(closed.flow_force_per_pressure_N_Pa, least_force_per_pressure_N_Pa);
  EXPECT_DOUBLE_EQ(closed.conductance, 0);
}

}  // namespace
}  // namespace spoolflow::sensor
