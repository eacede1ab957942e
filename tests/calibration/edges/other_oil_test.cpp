/// Maps of one oil temperature against an orifice whose laws are known.
#include "spoolflow/calibration/edges/other_oil.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/model/oil.hpp"
#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::calibration {
namespace {

const model::Fluid hlp46{"", 874, 46e-6, 6.8e-6};

double density(double oil_K) {
  return 850 * (1 - model::thermal_expansion_per_K * (oil_K - 323.15));
}
double viscosity(double oil_K) {
  return model::viscosity_m2_per_s(hlp46, oil_K);
}

/// dp = rho (Q/A)^2 + 1.2e5 rho nu Q/A, with the area A in proportion to the position.
double conductance(double position_m, double pressure_Pa, double oil_K) {
  const double area_m2 = 0.02 * position_m, part = 6e4 * density(oil_K) * viscosity(oil_K);
  return area_m2 * (std::sqrt(part * part + density(oil_K) * pressure_Pa) - part) / density(oil_K) /
         std::sqrt(pressure_Pa);
}
/// 20 N at 1 mm and 70 bar, more where the boundary layer is thick.
double flow_force_N(double position_m, double pressure_Pa, double oil_K) {
  const double boundary_layer = std::sqrt(viscosity(oil_K) / 30e-6) * std::pow(7e6 / pressure_Pa, 0.25);
  return 20 * position_m / 1e-3 * pressure_Pa / 7e6 * (1 + 0.2 * boundary_layer);
}

sensor::MeteringEdge<double> measured_at(double oil_K) {
  sensor::MeteringEdge<double> out = sensor::closed_form_edge<double>(sensor::closed_form);
  out.temperature_K = {oil_K - 5, 5, 0.2};
  for (int layer = 0; layer < sensor::edge_temperatures; ++layer) {
    for (int row = 0; row < sensor::edge_pressures; ++row) {
      for (int column = 0; column < sensor::edge_positions; ++column) {
        const double position_m = out.position_m.at(column),
                     pressure_Pa = out.pressure_difference_Pa.at(std::max(row, 1));
        out.conductance.node(layer, row, column) = conductance(position_m, pressure_Pa, oil_K);
        out.flow_force_N.node(layer, row, column) = row == 0 ? 0 : flow_force_N(position_m, pressure_Pa, oil_K);
      }
    }
  }
  return out;
}

TEST(OtherOil, FollowsFromMapsOfOneTemperatureByDensityAndViscosity) {
  constexpr double measured_K = 323.15, position_m = 1.1e-3;
  const sensor::MeteringEdge<double> alike = measured_at(measured_K);
  sensor::MeteringEdge<double> edge = alike;
  continue_to_other_oil(edge, measured_K, hlp46);
  for (const double pressure_Pa : {25e5, 62.5e5}) {
    const auto at = [&](double oil_K) { return edge.at(oil_K, pressure_Pa, position_m); };
    EXPECT_NEAR(at(measured_K).conductance, alike.at(measured_K, pressure_Pa, position_m).conductance, 1e-12);
    for (const double oil_K : {318.15, 328.15}) {
      EXPECT_NEAR(at(oil_K).conductance / conductance(position_m, pressure_Pa, oil_K), 1, 2e-3) << oil_K;
      EXPECT_NEAR(at(oil_K).flow_force_N / flow_force_N(position_m, pressure_Pa, oil_K), 1, 2e-3) << oil_K;
    }
    // Beyond the layers the trend goes on; maps that stay as they are would be off by up to 9 and 15 %.
    const sensor::EdgePoint<double> stays = alike.at(measured_K, pressure_Pa, position_m);
    for (const double oil_K : {293.15, 353.15}) {
      const double passes = conductance(position_m, pressure_Pa, oil_K),
                   pushes_N = flow_force_N(position_m, pressure_Pa, oil_K);
      EXPECT_LT(std::abs(at(oil_K).conductance - passes), 0.65 * std::abs(stays.conductance - passes)) << oil_K;
      EXPECT_LT(std::abs(at(oil_K).flow_force_N - pushes_N), 0.65 * std::abs(stays.flow_force_N - pushes_N)) << oil_K;
    }
  }
}

TEST(OtherOil, WithoutViscosityInTheMapsChangesByItsDensityAlone) {
  sensor::MeteringEdge<double> edge = measured_at(323.15);
  for (int layer = 0; layer < sensor::edge_temperatures; ++layer) {
    for (int row = 0; row < sensor::edge_pressures; ++row) {
      for (int column = 0; column < sensor::edge_positions; ++column) edge.conductance.node(layer, row, column) = 1e-7;
    }
  }
  continue_to_other_oil(edge, 323.15, hlp46);
  EXPECT_NEAR(edge.at(318.15, 60e5, 1e-3).conductance / 1e-7, 1 - model::thermal_expansion_per_K * 2.5, 1e-5);
}

TEST(Viscosity, IsThatOfTheDataSheetAndOfHlp46WhereItGivesNone) {
  const model::Fluid thin{"", 860, 32e-6, 5.4e-6}, unknown{}, upside_down{"", 860, 5e-6, 30e-6};
  EXPECT_NEAR(model::viscosity_m2_per_s(thin, 313.15), 32e-6, 1e-9);
  EXPECT_NEAR(model::viscosity_m2_per_s(thin, 373.15), 5.4e-6, 1e-9);
  for (const model::Fluid& fluid : {unknown, upside_down}) {
    EXPECT_NEAR(model::viscosity_m2_per_s(fluid, 313.15), 46e-6, 1e-9);
    EXPECT_NEAR(model::viscosity_m2_per_s(fluid, 373.15), 6.8e-6, 1e-9);
  }
  EXPECT_GT(model::viscosity_m2_per_s(hlp46, 273.15),
            8 * model::viscosity_m2_per_s(hlp46, 313.15));  // cold oil is stiff
}

}  // namespace
}  // namespace spoolflow::calibration
