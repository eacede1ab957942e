#include "spoolflow/rig/hydraulics/metering_edge.hpp"

#include <gtest/gtest.h>

#include "spoolflow/rig/hydraulics/flow_force.hpp"

namespace spoolflow::rig {
namespace {

constexpr double density = 860.0;
constexpr double warm_viscosity = 30e-6;

EdgeFlow flow(const MeteringEdge& edge, double travel_m, double pressure_Pa,
              double viscosity_m2_per_s = warm_viscosity) {
  return edge_flow(edge, edge_constants(edge, 12e-3, 5e-6, density, viscosity_m2_per_s), travel_m, pressure_Pa);
}

TEST(RigMeteringEdge, IsAnOrificeAtHighReynoldsNumber) {
  const MeteringEdge edge{.transition_reynolds = 1.0, .channel_area_m2 = 1.0, .edge_radius_m = 0.0};
  const EdgeFlow open = flow(edge, 1.5e-3, 60e5, 1e-8);
  const double notch = edge.notches * 1.35e-3 * (edge.notch_width_m + edge.notch_flank * 1.35e-3);
  EXPECT_NEAR(open.area_m2, notch, 1e-12);
  const double orifice = edge.discharge_coefficient * notch * std::sqrt(2.0 * 60e5 / density);
  EXPECT_NEAR((open.flow_m3_per_s - open.leakage_m3_per_s) / orifice, 1.0, 1e-6);
}

TEST(RigMeteringEdge, LosesAsTurbulentAndLaminarResistanceInSeries) {
  const MeteringEdge edge;
  const EdgeFlow open = flow(edge, 1.0e-3, 35e5);
  const double u = open.velocity_m_per_s;
  const double reynolds = 2.0 * open.opening_m * u / warm_viscosity;
  const double rounded = edge.edge_radius_m / (edge.edge_radius_m + open.opening_m);
  const double discharge = edge.discharge_coefficient + (0.95 - edge.discharge_coefficient) * rounded;
  const double turbulent = 0.5 * density * u * u;
  const double loss = turbulent / (discharge * discharge) * (1.0 + edge.transition_reynolds / reynolds) +
                      turbulent * open.area_m2 * open.area_m2 / (edge.channel_area_m2 * edge.channel_area_m2);
  EXPECT_NEAR(loss / 35e5, 1.0, 1e-9);
}

TEST(RigMeteringEdge, IsLinearInPressureAtLowReynoldsNumber) {
  const MeteringEdge edge;
  EXPECT_NEAR(flow(edge, 1e-3, 2.0).flow_m3_per_s / flow(edge, 1e-3, 1.0).flow_m3_per_s, 2.0, 1e-2);
}

TEST(RigMeteringEdge, FlowIsOddInPressureDifference) {
  for (const double travel_m : {-1e-3, 0.14e-3, 0.152e-3, 0.8e-3}) {
    EXPECT_EQ(flow({}, travel_m, 20e5).flow_m3_per_s, -flow({}, travel_m, -20e5).flow_m3_per_s) << travel_m;
  }
}

TEST(RigMeteringEdge, StatedSlopesAreThoseOfItsFlow) {
  const MeteringEdge edge;
  for (const double pressure_Pa : {-40e5, 1e4, 60e5}) {
    for (double travel_m = -0.5e-3; travel_m < 2.4e-3; travel_m += 3.7e-6) {
      const double dp = 1e-6 * std::abs(pressure_Pa);
      const double dx = 1e-10;
      const EdgeFlow at = flow(edge, travel_m, pressure_Pa);
      const double conductance = (flow(edge, travel_m, pressure_Pa + dp).flow_m3_per_s -
                                  flow(edge, travel_m, pressure_Pa - dp).flow_m3_per_s) /
                                 (2 * dp);
      const double gain = (flow(edge, travel_m + dx, pressure_Pa).flow_m3_per_s -
                           flow(edge, travel_m - dx, pressure_Pa).flow_m3_per_s) /
                          (2 * dx);
      EXPECT_NEAR(at.conductance_m3_per_s_Pa / conductance, 1.0, 1e-5) << travel_m;
      EXPECT_NEAR(at.flow_gain_m2_per_s, gain, 1e-4 * std::abs(gain) + 1e-6) << travel_m;
    }
  }
}

TEST(RigMeteringEdge, LeaksThroughItsClearanceInsideTheOverlap) {
  const MeteringEdge edge;
  const EdgeFlow closed = flow(edge, 0.0, 60e5);
  EXPECT_EQ(closed.area_m2, 0.0);
  const double annulus = std::numbers::pi * 12e-3 * std::pow(5e-6, 3) * (1.0 + 1.5 * 0.25) /
                         (12.0 * density * warm_viscosity * (edge.sealing_length_m + edge.overlap_m)) * 60e5;
  EXPECT_NEAR(closed.flow_m3_per_s / annulus, 1.0, 1e-12);
}

TEST(RigMeteringEdge, WornEdgeOpensEarlierAndPassesMore) {
  const MeteringEdge worn{.edge_radius_m = 40e-6};
  EXPECT_GT(flow(worn, 0.13e-3, 60e5).area_m2, 0.0);
  EXPECT_EQ(flow({}, 0.13e-3, 60e5).area_m2, 0.0);
  EXPECT_GT(flow(worn, 0.3e-3, 60e5).flow_m3_per_s, 1.05 * flow({}, 0.3e-3, 60e5).flow_m3_per_s);
}

TEST(RigMeteringEdge, AScratchLeaksInProportionToThePressureWhateverTheOpening) {
  const MeteringEdge scratched{.scratch_m3_per_s_Pa = 8.3e-13};
  for (const double travel_m : {-0.5e-3, 0.14e-3, 1.5e-3}) {
    const EdgeFlow with = flow(scratched, travel_m, 60e5), without = flow({}, travel_m, 60e5);
    EXPECT_NEAR(60000 * (with.flow_m3_per_s - without.flow_m3_per_s), 0.3, 0.002);  // L/min
    EXPECT_NEAR(with.leakage_m3_per_s - without.leakage_m3_per_s, 60e5 * 8.3e-13, 1e-12);
    EXPECT_EQ(with.flow_gain_m2_per_s, without.flow_gain_m2_per_s);
  }
}

TEST(RigFlowForce, IsTheMomentumOfJetAndOutlet) {
  const MeteringEdge edge;
  const FlowForce law;
  const EdgeConstants constants = edge_constants(edge, 12e-3, 5e-6, density, warm_viscosity);
  const EdgeFlow open = edge_flow(edge, constants, 1.2e-3, 50e5);
  const EdgeForce force = edge_force(law, constants, open, warm_viscosity);
  const double Q = open.area_m2 * open.velocity_m_per_s;
  const double A1 = law.jet_contraction * open.area_m2 / force.jet.sine;  // radial area the jet fills
  const double paper_2 = density * Q * Q * force.jet.cosine / (A1 * force.jet.sine) -
                         density * Q * Q * edge.outlet_cotangent / edge.outlet_area_m2;
  EXPECT_NEAR(force.steady_N / paper_2, 1.0, 1e-9);
  EXPECT_GT(force.steady_N, 0.0);
}

TEST(RigFlowForce, ClosesWhicheverWayTheOilFlows) {
  const MeteringEdge edge;
  const EdgeConstants constants = edge_constants(edge, 12e-3, 5e-6, density, warm_viscosity);
  const EdgeForce forth = edge_force({}, constants, edge_flow(edge, constants, 1.2e-3, 50e5), warm_viscosity);
  const EdgeForce back = edge_force({}, constants, edge_flow(edge, constants, 1.2e-3, -50e5), warm_viscosity);
  EXPECT_EQ(forth.steady_N, back.steady_N);
}

TEST(RigFlowForce, AcceleratingOilPushesWithItsColumn) {
  const EdgeConstants constants = edge_constants({}, 12e-3, 5e-6, density, warm_viscosity);
  EXPECT_NEAR(transient_force_N(constants, density, 0.012, 0.4, 60e5), -density * 0.012 * 0.4, 1e-3);
  EXPECT_GT(transient_force_N(constants, density, 0.012, 1e9, 60e5), -60e5 * constants.chamber_area_m2 - 1.01);
}

}  // namespace
}  // namespace spoolflow::rig
