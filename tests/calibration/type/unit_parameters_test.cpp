#include "spoolflow/calibration/type/unit_parameters.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {
namespace {

const model::Model& example_type() {
  static const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  return model;
}
const sensor::ObserverParameters<double>& observer() {
  return example_type().observer->parameters;
}
Deviations only(Variation variation, double value) {
  Deviations out{};
  out[at(variation)] = value;
  return out;
}

TEST(UnitParameters, WithoutDeviationsAreTheTypesOwn) {
  const sensor::ObserverParameters<double> unit = unit_parameters(observer(), {});
  EXPECT_EQ(unit.actuator.magnetic_force.map.values, observer().actuator.magnetic_force.map.values);
  EXPECT_EQ(unit.actuator.coil.flux_linkage.map.values, observer().actuator.coil.flux_linkage.map.values);
  EXPECT_EQ(unit.spring.curve.values, observer().spring.curve.values);
  EXPECT_EQ(unit.edge.conductance.values, observer().edge.conductance.values);
  EXPECT_EQ(unit.edge.flow_force_N.values, observer().edge.flow_force_N.values);
  EXPECT_EQ(unit.edge.friction_N.values, observer().edge.friction_N.values);
  const sensor::CondensedParameters<double> condensed = unit_parameters(example_type().condensed.parameters, {});
  EXPECT_EQ(condensed.flow_rate.flow_m3_per_s.values,
            example_type().condensed.parameters.flow_rate.flow_m3_per_s.values);
}

TEST(UnitParameters, ACoilOfMoreTurnsNeedsLessCurrentForTheSameForceAndLinksMoreFlux) {
  const double turns = 1.02;
  const sensor::ObserverParameters<double> unit = unit_parameters(observer(), only(Variation::turns, turns - 1));
  for (const double current_A : {0.4, 0.9, 1.7}) {
    for (const double position_m : {0.3e-3, 1.1e-3, 2.2e-3}) {
      EXPECT_NEAR(unit.actuator.magnetic_force.at(current_A / turns, position_m).value,
                  observer().actuator.magnetic_force.at(current_A, position_m).value, 1e-9);
      EXPECT_NEAR(unit.actuator.coil.flux_linkage.map.at(current_A / turns, position_m).value,
                  turns * observer().actuator.coil.flux_linkage.map.at(current_A, position_m).value, 1e-12);
    }
  }
  EXPECT_NEAR(sensor::saturated_output(unit.actuator.coil.hysteresis, 0.5),
              sensor::saturated_output(observer().actuator.coil.hysteresis, 0.5) / turns, 1e-12);
}

TEST(UnitParameters, AMorePermeableGapPullsHarderWhereIronIsUnsaturatedAndLessAtTheSameFlux) {
  const double permeance = 0.03;
  const sensor::ObserverParameters<double> unit = unit_parameters(observer(), only(Variation::permeance, permeance));
  const double position_m = 1.2e-3, current_A = 0.5;
  const double before_N = observer().actuator.magnetic_force.at(current_A, position_m).value;
  EXPECT_GT(unit.actuator.magnetic_force.at(current_A, position_m).value, (1 + 0.5 * permeance) * before_N);
  // The current of the unit at the flux that the type has at `current_A`.
  const double flux_Wb = observer().actuator.coil.flux_linkage.map.at(current_A, position_m).value;
  double low_A = 0, high_A = 2;
  for (int k = 0; k < 50; ++k) {
    const double middle_A = 0.5 * (low_A + high_A);
    (unit.actuator.coil.flux_linkage.map.at(middle_A, position_m).value < flux_Wb ? low_A : high_A) = middle_A;
  }
  EXPECT_LT(low_A, current_A);
  EXPECT_NEAR(unit.actuator.magnetic_force.at(low_A, position_m).value, before_N / (1 + permeance), 0.01 * before_N);
}

TEST(UnitParameters, ZeroAndGainOfThePositionSensorChangeNothingOfTheValve) {
  Deviations deviations = only(Variation::position_zero, 12e-6);
  deviations[at(Variation::position_gain)] = 0.004;
  sensor::ObserverParameters<double> type = observer();
  EXPECT_GT(unit_parameters(type, deviations).stopped_above_m, 0.9 * sensor::no_open_stop_m);
  type.stopped_above_m = 2.6e-3;
  const sensor::ObserverParameters<double> unit = unit_parameters(type, deviations);
  EXPECT_NEAR(unit.stopped_above_m, 1.004 * type.stopped_above_m + 12e-6, 1e-9);
  for (const double position_m : {0.4e-3, 1.3e-3, 2.1e-3}) {
    const double read_m = 1.004 * position_m + 12e-6;
    EXPECT_NEAR(unit.spring.at(read_m).value, observer().spring.at(position_m).value, 1e-9);
    EXPECT_NEAR(unit.edge.at(323.15, 40e5, read_m).flow_force_N,
                observer().edge.at(323.15, 40e5, position_m).flow_force_N, 1e-9);
    EXPECT_NEAR(unit.actuator.magnetic_force.at(0.8, read_m).value,
                observer().actuator.magnetic_force.at(0.8, position_m).value, 1e-9);
  }
}

TEST(UnitParameters, AnEdgeThatOpensLaterPassesTheSameFlowSoMuchFurtherOn) {
  const double later_m = 20e-6;
  const sensor::ObserverParameters<double> unit = unit_parameters(observer(), only(Variation::edge_position, later_m));
  const double widest = observer().edge.at(323.15, 40e5, 2.3e-3).conductance;
  for (const double position_m : {0.5e-3, 1.2e-3, 2.0e-3}) {
    EXPECT_NEAR(unit.edge.at(323.15, 40e5, position_m + later_m).conductance,
                observer().edge.at(323.15, 40e5, position_m).conductance, 1e-3 * widest);
  }
  EXPECT_NEAR(unit.closed_below_m, observer().closed_below_m + later_m, 1e-12);
  EXPECT_EQ(unit.spring.curve.values, observer().spring.curve.values);
}

TEST(UnitParameters, AWiderEdgePassesMoreAndItsFlowForceGrowsWithTheFlow) {
  const sensor::ObserverParameters<double> unit = unit_parameters(observer(), only(Variation::edge_width, 0.02));
  const sensor::EdgePoint<double> before = observer().edge.at(323.15, 40e5, 1.5e-3),
                                  after = unit.edge.at(323.15, 40e5, 1.5e-3);
  EXPECT_NEAR(after.conductance, 1.02 * before.conductance, 1e-12);
  EXPECT_NEAR(after.flow_force_N, 1.02 * before.flow_force_N, 1e-9);
  EXPECT_DOUBLE_EQ(after.friction_N, before.friction_N);
}

TEST(UnitParameters, ASpoolThatStrengthensTwiceAsFastHoldsAfterHalfTheRest) {
  const sensor::ObserverParameters<double> unit =
      unit_parameters(observer(), only(Variation::ageing_time, -std::log(2.0)));
  for (const double rest_s : {0.1, 1.0, 10.0})
    EXPECT_NEAR(sensor::ageing(unit.friction, 0.5 * rest_s), sensor::ageing(observer().friction, rest_s), 1e-12);
}

}  // namespace
}  // namespace spoolflow::calibration
