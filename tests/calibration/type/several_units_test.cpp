#include "spoolflow/calibration/type/several_units.hpp"

#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "tests/calibration/type/virtual_unit.hpp"

namespace spoolflow::calibration {
namespace {

using testing::HasSubstr;

const model::Model& valve() {
  static const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  return model;
}

model::Model unit(const std::string& name, const Deviations& deviations) {
  model::Model out = valve();
  out.valve.name = name;
  out.observer->parameters = unit_parameters(out.observer->parameters, deviations);
  return out;
}

/// Units whose springs differ by `spread` times what is usual, and whose other directions do by half of that.
std::vector<model::Model> series(int count, double spread) {
  std::mt19937 seed(5);
  std::normal_distribution<double> normal;
  std::vector<model::Model> out;
  const Deviations usual = tolerances_from({});
  for (int k = 0; k < count; ++k) {
    Deviations deviations{};
    for (std::size_t v = 0; v < variations; ++v) {
      const bool spring = v == at(Variation::spring_preload);
      deviations[v] = (spring ? spread : 0.5) * usual[v] * normal(seed);
    }
    out.push_back(unit("U" + std::to_string(k), deviations));
  }
  return out;
}

double spread_in(const SeveralUnits& compared, Variation variation) {
  const auto row = static_cast<Eigen::Index>(at(variation));
  return std::sqrt(compared.next.covariance(row, row));
}

/// Of three whose springs lie at 0, a and 2a.
std::vector<model::Model> three(double apart) {
  std::vector<model::Model> out;
  for (const int k : {0, 1, 2}) {
    Deviations deviations{};
    deviations[at(Variation::spring_preload)] = apart * k;
    deviations[at(Variation::edge_width)] = -0.3 * apart * k;
    out.push_back(unit("U" + std::to_string(k), deviations));
  }
  return out;
}

TEST(SeveralUnits, OfWholeValvesEachDirectionHasItsOwnMiddle) {
  std::vector<model::Model> units = three(0.03);
  const std::vector<model::Model> of_one = units;
  for (std::size_t k = 0; k < units.size(); ++k) {  // P to A springs rise the other way
    units[k] = whole_of(units[k]);
    units[k].p_to_a->observer = of_one[units.size() - 1 - k].observer;
  }
  const TypeOfUnits type = type_of_units(units, tolerances_from({}));
  ASSERT_EQ(type.compared.size(), 2U);
  const auto preload = at(Variation::spring_preload);
  EXPECT_LT(type.compared[0].units[0].deviations[preload], -0.01);
  EXPECT_GT(type.compared[1].units[0].deviations[preload], 0.01);
  EXPECT_TRUE(type.model.type && type.model.p_to_a->type);
  EXPECT_EQ(type.model.valve.direction, "both");
}

TEST(SeveralUnits, TheTypeHasTheTablesOfTheirMiddle) {
  const std::vector<model::Model> units = three(0.03);
  const SeveralUnits compared = compare_units(units, tolerances_from({}));
  const model::Model type = type_of(units, compared);
  for (const double position_m : {0.5e-3, 1.2e-3, 2.0e-3}) {
    EXPECT_NEAR(type.observer->parameters.spring.at(position_m).value,
                units[1].observer->parameters.spring.at(position_m).value, 0.15);
    EXPECT_NEAR(type.observer->parameters.edge.at(323.15, 40e5, position_m).conductance /
                    units[1].observer->parameters.edge.at(323.15, 40e5, position_m).conductance,
                1, 2e-3);
  }
  EXPECT_NEAR(compared.units[2].deviations[at(Variation::spring_preload)], 0.03, 0.008);
  EXPECT_NEAR(compared.units[0].deviations[at(Variation::edge_width)], 0.009, 0.004);
  EXPECT_LT(compared.units[2].force_left_N, 0.1);
}

TEST(SeveralUnits, SpringsThatLieFurtherApartThanToleratedWidenTheTypeAndEvenOnesNarrowIt) {
  const Deviations usual = tolerances_from({});
  const double tolerance = usual[at(Variation::spring_preload)];
  const SeveralUnits wide = compare_units(series(8, 1.8), usual), narrow = compare_units(series(8, 0.2), usual);
  EXPECT_GT(spread_in(wide, Variation::spring_preload), 1.2 * tolerance);
  EXPECT_LT(spread_in(narrow, Variation::spring_preload), 0.8 * tolerance);
  EXPECT_NEAR(spread_in(wide, Variation::position_zero), usual[at(Variation::position_zero)],
              0.35 * usual[at(Variation::position_zero)]);  // no table shows it
}

TEST(SeveralUnits, WhoseTypeCalibratesUnitsAsAnyOther) {
  const std::vector<model::Model> units = series(4, 1);
  const model::Model type = type_of(units, compare_units(units, tolerances_from({})));
  const KnownDeviations known = known_of_type(type, "type.json");
  EXPECT_EQ(known.mean.norm(), 0);
  EXPECT_EQ(known.covariance.llt().info(), Eigen::Success);  // a spread in every direction
  EXPECT_GT(type.observer->parameters.environment.force_N, 0.3);
}

TEST(SeveralUnits, OneUnitUnderTwoNamesIsNamed) {
  std::vector<model::Model> units = three(0.02);
  units.push_back(units[1]);
  units.back().valve.name = "U1 again";
  try {
    (void)compare_units(units, tolerances_from({}));
    FAIL() << "the spread was found too narrow";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("U1 and U1 again measured the same"));
  }
}

TEST(SeveralUnits, TwoAreNoTypeAndAValveOfAnotherSpringIsNamed) {
  std::vector<model::Model> units = three(0.02);
  units.pop_back();
  EXPECT_THROW((void)compare_units(units, tolerances_from({})), CalibrationError);
  units = three(0.01);
  Deviations foreign{};
  foreign[at(Variation::spring_rate)] = 0.25;
  units.push_back(unit("of another lot", foreign));
  try {
    (void)compare_units(units, tolerances_from({}));
    FAIL() << "a spring of another rate passed for one of the type";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("of another lot is not of one type with the others: its spring_rate"));
  }
  units.back() = unit("longer", {});
  units.back().valve.stroke_m *= 1.2;
  EXPECT_THROW((void)compare_units(units, tolerances_from({})), CalibrationError);
}

/// As a flow bench gives it, whose newtons are `newton` of a load cell's.
model::Model from_flow_bench(model::Model unit, double newton) {
  sensor::ObserverParameters<double>& of = unit.observer->parameters;
  const auto scale = [&](auto& values) {
    for (double& value : values) value *= newton;
  };
  scale(of.actuator.magnetic_force.map.values);
  scale(of.actuator.magnetic_force.hysteresis_half_width_N.values);
  scale(of.actuator.friction_N.values);
  scale(of.spring.curve.values);
  for (int layer = 0; layer < sensor::edge_temperatures; ++layer) {
    for (int row = 0; row < sensor::edge_pressures; ++row) {
      for (int column = 0; column < sensor::edge_positions; ++column) {
        of.edge.flow_force_N.node(layer, row, column) *= newton;
        of.edge.friction_N.node(layer, row, column) *= newton;
      }
    }
  }
  unit.provenance.quantities = {{"b", std::string(model::scale_of_forces), "inferred", "coenergy", "1", 0.28}};
  return unit;
}

/// Two units of the valve, and the third; newtons of each are its own flow bench's.
std::vector<model::Model> on_flow_benches(const Deviations& third) {
  Deviations second{};
  second[at(Variation::resistance)] = 0.01;  // no two units measure the same
  return {from_flow_bench(unit("U0", {}), 1), from_flow_bench(unit("U1", second), 0.8),
          from_flow_bench(unit("U2", third), 1.25)};
}

TEST(SeveralUnits, OnFlowBenchesMayReadEachItsOwnNewtons) {
  Deviations third{};
  third[at(Variation::resistance)] = -0.01;
  std::vector<model::Model> units = on_flow_benches(third);
  const Deviations usual = tolerances_from({});
  const SeveralUnits compared = compare_units(units, usual);
  for (const MeasuredUnit& each : compared.units) {
    for (const Variation of : {Variation::spring_preload, Variation::spring_rate, Variation::permeance,
                               Variation::flow_force, Variation::spool_friction})
      EXPECT_LT(std::abs(each.deviations[at(of)]), 0.1 * usual[at(of)]);
    EXPECT_LT(each.force_left_N, 0.05);
  }
  for (model::Model& each : units) each.provenance.quantities.clear();  // as if load cells had measured that
  EXPECT_THROW((void)compare_units(units, usual), CalibrationError);
}

TEST(SeveralUnits, OnFlowBenchesShowASpringThatStandsAgainstMoreCurrent) {
  Deviations third{};
  third[at(Variation::spring_preload)] = 0.06;
  const SeveralUnits compared = compare_units(on_flow_benches(third), tolerances_from({}));
  EXPECT_NEAR(compared.units[2].deviations[at(Variation::spring_preload)] -
                  compared.units[0].deviations[at(Variation::spring_preload)],
              0.06, 0.02);
  EXPECT_LT(compared.units[2].force_left_N, 0.1);
}

TEST(SeveralUnits, OfAnotherSpringIsNamedByFlowBenchesToo) {
  Deviations foreign{};
  foreign[at(Variation::spring_rate)] = 0.25;
  try {
    (void)compare_units(on_flow_benches(foreign), tolerances_from({}));
    FAIL() << "a spring of another rate passed for one of the type";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("U2 is not of one type with the others: its spring_rate"));
  }
}

}  // namespace
}  // namespace spoolflow::calibration
