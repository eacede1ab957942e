#include "spoolflow/calibration/type/calibrate_unit.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/environment.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/spread.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_agreement.hpp"
#include "spoolflow/calibration/type/unit_evidence.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/calibration/type/unit_folder.hpp"
#include "tests/calibration/type/virtual_unit.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

using testing::HasSubstr;

constexpr double oil_K = 323.15;

std::string nothing(const std::string&) {
  return "";
}
constexpr std::size_t position_column = 1, current_column = 2, pressure_column = 4;

/// Flow at a force that balances, from the sensor's chain: what remains wrong of the unit's flow at one point.
double flow_error(const sensor::ObserverParameters<double>& found, const sensor::ObserverParameters<double>& truth,
                  double position_m) {
  const double pressure_Pa = 40e5;
  const sensor::EdgePoint<double> there = truth.edge.at(oil_K, pressure_Pa, position_m);
  double low_A = 0, high_A = 2.4;
  for (int k = 0; k < 40; ++k) {
    const double middle_A = 0.5 * (low_A + high_A);
    const double net_N = truth.actuator.magnetic_force.at(middle_A, position_m).value -
                         truth.spring.at(position_m).value - there.flow_force_N;
    (net_N < 0 ? low_A : high_A) = middle_A;
  }
  const sensor::EdgePoint<double> here = found.edge.at(oil_K, pressure_Pa, position_m);
  const double left_N =
      found.actuator.magnetic_force.at(low_A, position_m).value - found.spring.at(position_m).value - here.flow_force_N;
  const double estimated_Pa = pressure_Pa + left_N / here.flow_force_per_pressure_N_Pa;
  return here.conductance * std::sqrt(estimated_Pa) / (there.conductance * std::sqrt(pressure_Pa)) - 1;
}

const sensor::Environment<double>& machine_of(const model::Model& model) {
  return model.observer->parameters.environment;
}

TEST(TypeModel, StaysAsWideAsItsUnitsDifferWhateverMachineIsDeclared) {
  model::Model declared = type();
  apply(recording::machine_environment(), declared);
  EXPECT_GE(machine_of(declared).force_N, machine_of(type()).force_N);
  EXPECT_GT(machine_of(declared).flow_share, machine_of(type()).flow_share);
  EXPECT_GT(machine_of(declared).friction_share, machine_of(type()).friction_share);
  apply({}, declared);  // a bench leaves nothing open but the units' spread
  EXPECT_DOUBLE_EQ(machine_of(declared).force_N, machine_of(type()).force_N);
  EXPECT_DOUBLE_EQ(machine_of(declared).flow_share, machine_of(type()).flow_share);
}

TEST(CalibrateUnit, LeavesOpenWhatItsFlowMeterIsWrongBy) {
  const UnitFolder folder({});
  const UnitCalibration usual = folder.calibrate();
  const UnitCalibration worse = folder.calibrate("[instruments]\nflow_uncertainty_percent = 6\n");
  const auto edge_width = [](const UnitCalibration& unit) { return unit.parameters[at(Variation::edge_width)]; };
  EXPECT_GT(edge_width(worse).uncertainty, 1.3 * edge_width(usual).uncertainty);
  EXPECT_GT(machine_of(worse.model).flow_share, 1.2 * machine_of(usual.model).flow_share);
  EXPECT_LT(machine_of(worse.model).flow_share, machine_of(type()).flow_share);
}

TEST(CalibrateUnit, IsMeasuredInTheOilOfItsType) {
  const UnitFolder folder({});
  EXPECT_NO_THROW((void)folder.calibrate("[fluid]\nname = \"HLP46\"\nviscosity_40C_mm2_per_s = 46\n"));
  try {
    (void)folder.calibrate("[fluid]\nviscosity_40C_mm2_per_s = 32\n");
    FAIL() << "another oil passed";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("said.toml: viscosity_40C_mm2_per_s = 32 in [fluid], and the type's campaign "
                                        "has 46; the tables are of the type's oil: leave [fluid] out"));
  }
}

TEST(CalibrateUnit, FindsAUnitsFlowWithinAHundredthWhereItsTypeErrsByMore) {
  Deviations deviations{};
  deviations[at(Variation::spring_preload)] = 0.04;
  deviations[at(Variation::spring_rate)] = 0.02;
  deviations[at(Variation::permeance)] = -0.02;
  deviations[at(Variation::edge_position)] = 10e-6;
  deviations[at(Variation::edge_width)] = 0.015;
  deviations[at(Variation::spool_friction)] = 0.3;
  deviations[at(Variation::position_zero)] = 6e-6;
  const UnitCalibration unit = UnitFolder(deviations).calibrate();
  const sensor::ObserverParameters<double> truth = unit_parameters(type().observer->parameters, deviations);
  for (const double position_m : {1.0e-3, 1.6e-3, 2.2e-3}) {
    EXPECT_NEAR(flow_error(unit.model.observer->parameters, truth, position_m), 0, 0.01);
    EXPECT_GT(std::abs(flow_error(type().observer->parameters, truth, position_m)), 0.01);
  }
  EXPECT_EQ(unit.model.valve.name, "U 17");
  EXPECT_TRUE(unit.model.type->unit);
  EXPECT_LT(unit.model.observer->parameters.environment.force_N, 0.5 * type().observer->parameters.environment.force_N);
}

TEST(CalibrateUnit, ASpoolThatSticksAndSlipsUnderPressureShowsItsForcesAsOftenAsOneThatSlides) {
  Deviations deviations{};
  deviations[at(Variation::flow_force)] = 0.03;
  constexpr double slip_m = 30e-6;
  const UnitFolder slips(deviations, slip_m), slides(deviations);
  EXPECT_GT(slips.force_rows(), slides.force_rows() / 2);
  const UnitCalibration unit = slips.calibrate();
  const UnitParameter& flow_force = unit.parameters[at(Variation::flow_force)];
  EXPECT_NEAR(flow_force.value, deviations[at(Variation::flow_force)], 2 * flow_force.uncertainty);
  const sensor::ObserverParameters<double> truth = unit_parameters(type().observer->parameters, deviations);
  for (const double position_m : {1.0e-3, 1.6e-3, 2.2e-3})
    EXPECT_NEAR(flow_error(unit.model.observer->parameters, truth, position_m), 0, 0.01);
}

TEST(CalibrateUnit, ASpoolThatRunsAcrossItsStrokeInASecondShowsNoForces) {
  const auto force_rows = [](double way_s) {
    const recording::TemporaryFile file("wet.csv", "");
    write_strokes(file.path(), type().observer->parameters, {40}, type().valve.stroke_m, way_s);
    const recording::Recording wet = recording::read_recording(file.path(), {});
    const UnitEvidence evidence(type(), {{&wet, recording::Protocol::operation}});
    return std::ranges::count(evidence.kinds(), EvidenceOf::force);
  };
  EXPECT_GT(force_rows(6), 20) << "at the speed of force benches and planned strokes";
  EXPECT_EQ(force_rows(1), 0) << "contacts that slide faster are younger, and friction is less than the maps'";
}

/// A unit of strokes with the pump off whose file holds text before and behind them.
CalibratedUnit unit_with(const std::string& before, const std::string& behind = "") {
  const recording::TemporaryFile file("unit.toml", before +
                                                       "[[recording]]\nprotocol = \"unpressurised_strokes\"\nfile = "
                                                       "\"dry.csv\"\n" +
                                                       behind);
  write_strokes(file.folder() / "dry.csv", type().observer->parameters, {0, 0}, type().valve.stroke_m);
  std::ofstream(file.folder() / "type.json") << "{}";
  return calibrate_unit(type(), (file.folder() / "type.json").string(),
                        recording::read_unit_campaign(file.path(), valve_of_type(type())), "test",
                        [](const std::string&, double) {});
}

TEST(CalibrateUnit, WhatNoRecordingShowsStaysAtTheTypesSpreadAndIsNamed) {
  const UnitCalibration unit = unit_with("").directions.at(0);
  for (const UnitParameter& parameter : unit.parameters) {
    const bool of_pressure = parameter.name.starts_with("edge") || parameter.name.starts_with("flow_force") ||
                             parameter.name == "pressure_friction";
    if (of_pressure) {
      EXPECT_FALSE(parameter.seen) << parameter.name;
      EXPECT_NEAR(parameter.uncertainty, parameter.tolerance, 0.05 * parameter.tolerance) << parameter.name;
    }
    if (parameter.name == "spring_preload" || parameter.name == "position_zero") {
      EXPECT_TRUE(parameter.seen) << parameter.name;
    }
  }
}

TEST(CalibrateUnit, AFlowMeterWithoutPressureDifferenceShowsNoForces) {
  const UnitFolder folder({});
  folder.spoil("wet.csv", pressure_column, nothing);
  const UnitCalibration unit = folder.calibrate();
  for (const Variation each : {Variation::edge_position, Variation::flow_force, Variation::pressure_friction})
    EXPECT_FALSE(unit.parameters[at(each)].seen) << unit.parameters[at(each)].name;
}

TEST(CalibrateUnit, SamplesWithoutPressureDifferenceAreNoneWithoutFlow) {
  const UnitFolder folder({});
  constexpr std::size_t every = 60;
  folder.spoil("wet.csv", pressure_column, nothing, every);
  const UnitParameter edge_width = folder.calibrate().parameters[at(Variation::edge_width)];
  EXPECT_TRUE(edge_width.seen);
  EXPECT_NEAR(edge_width.value, 0, 2e-3);
}

TEST(CalibrateUnit, ARecordingThatShowsNothingOfItIsDoubtedWithTheReason) {
  const UnitFolder turned({}), dead({}), sound({});
  turned.spoil("dry.csv", position_column, [](const std::string& value) { return "-" + value; });
  (void)turned.calibrate();
  EXPECT_THAT(turned.doubts(), testing::Contains(testing::ContainsRegex(
                                   "dry.csv shows no forces and no flow of the unit: the spool nowhere moves slowly "
                                   "and without dither within the stroke of 0 to 2.40 mm.*position is -2.3")));
  dead.spoil("wet.csv", current_column, nothing);
  (void)dead.calibrate();
  EXPECT_THAT(dead.doubts(), testing::ElementsAre(HasSubstr("wet.csv shows no forces and no flow of the unit: channel "
                                                            "current has no values; record it again")));
  (void)sound.calibrate();
  EXPECT_THAT(sound.doubts(), testing::IsEmpty());
}

TEST(CalibrateUnit, TheUnitsOwnMachineWidensItsBand) {
  const model::Model bench = unit_with("").model, machine = unit_with("environment = \"machine\"\n").model;
  EXPECT_EQ(machine_of(bench).leakage_m3_per_s, 0);
  EXPECT_GT(machine_of(machine).leakage_m3_per_s, 0);
  EXPECT_GT(machine_of(machine).force_N, machine_of(bench).force_N);
}

TEST(CalibrateUnit, OneRecordingTwiceOrOfTheOtherDirectionIsRefusedWithItsLine) {
  const std::string again = "[[recording]]\nprotocol = \"unpressurised_strokes\"\nfile = \"dry.csv\"\n";
  const auto refusal = [](const std::string& behind) -> std::string {
    try {
      (void)unit_with("", behind);
      return "none";
    } catch (const CalibrationError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal(again), HasSubstr("unit.toml, line 4: dry.csv holds the same as dry.csv, which counts once"));
  EXPECT_THAT(refusal("direction = \"a\"\n"), HasSubstr("direction = \"a\", and the type is of \"b\" alone"));
}

/// What the type calls a unit that hangs for a third of a second at each place, with that logarithm of its ageing time.
UnitParameter found_ageing(double logarithm) {
  Deviations deviations{};
  deviations[at(Variation::ageing_time)] = logarithm;
  const recording::TemporaryFile file("unit.toml",
                                      "[[recording]]\nprotocol = \"unpressurised_strokes\"\nfile = \"dry.csv\"\n"
                                      "[[recording]]\nprotocol = \"operation\"\nfile = \"hangs.csv\"\n");
  const sensor::ObserverParameters<double> unit = unit_parameters(type().observer->parameters, deviations);
  constexpr double hangs_s = 0.3;
  write_strokes(file.folder() / "dry.csv", unit, {0, 0}, type().valve.stroke_m);
  write_stick_slip(file.folder() / "hangs.csv", unit, hangs_s, type().valve.stroke_m);
  std::ofstream(file.folder() / "type.json") << "{}";
  const UnitCalibration found = calibrated_unit(type(), (file.folder() / "type.json").string(),
                                                recording::read_unit_campaign(file.path(), valve_of_type(type())),
                                                "test", [](const std::string&, double) {});
  return found.parameters[at(Variation::ageing_time)];
}

TEST(CalibrateUnit, AHangingSpoolShowsHowFastItsFrictionGrowsAtRest) {
  const UnitParameter fast = found_ageing(-1), usual = found_ageing(0);
  EXPECT_TRUE(fast.seen);
  EXPECT_NEAR(fast.value, -1, 2 * fast.uncertainty);
  EXPECT_LT(fast.value, usual.value - 0.4);
}

TEST(CalibrateUnit, ASpoolThatOvershootsItsStrokeHasNoOtherPositionSensorForThat) {
  const recording::TemporaryFile file("unit.toml", "[[recording]]\nprotocol = \"operation\"\nfile = \"wet.csv\"\n");
  constexpr double overshoots = 1.05;
  write_strokes(file.folder() / "wet.csv", type().observer->parameters, {60, 60}, overshoots * type().valve.stroke_m);
  std::ofstream(file.folder() / "type.json") << "{}";
  const UnitCalibration unit = calibrated_unit(type(), (file.folder() / "type.json").string(),
                                               recording::read_unit_campaign(file.path(), valve_of_type(type())),
                                               "test", [](const std::string&, double) {});
  for (const UnitParameter& parameter : unit.parameters) EXPECT_LT(std::abs(parameter.deviations), 1) << parameter.name;
}

TEST(CalibrateUnit, AnotherSpringIsNoUnitOfTheTypeAndIsNamedByStandardDeviations) {
  Deviations deviations{};
  deviations[at(Variation::spring_rate)] = 0.25;
  try {
    (void)UnitFolder(deviations).calibrate();
    FAIL() << "a spring of another rate passed for one of the type";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the unit is not of the type"));
    EXPECT_THAT(error.what(), HasSubstr("spring_rate +"));
    EXPECT_THAT(error.what(), HasSubstr("standard deviations"));
  }
}

/// What is said of strokes of one unit beside a run of another.
std::string said_of_mixed(const Deviations& dry_unit, const Deviations& wet_unit) {
  const recording::TemporaryFile dry("dry.csv", ""), wet("wet.csv", "");
  const sensor::ObserverParameters<double>& of_type = type().observer->parameters;
  write_strokes(dry.path(), unit_parameters(of_type, dry_unit), {0, 0}, type().valve.stroke_m);
  write_strokes(wet.path(), unit_parameters(of_type, wet_unit), {40, 40}, type().valve.stroke_m);
  const recording::Recording read_dry = recording::read_recording(dry.path(), {}),
                             read_wet = recording::read_recording(wet.path(), {});
  return disagreeing_runs(
      type(), known_of_type(type(), "type.json"),
      {{&read_dry, recording::Protocol::unpressurised_strokes}, {&read_wet, recording::Protocol::operation}});
}

TEST(CalibrateUnit, RecordingsOfTwoUnitsAreNamedWithWhatSetsThemApart) {
  Deviations one{}, other{};
  one[at(Variation::spring_preload)] = 0.03;
  one[at(Variation::position_zero)] = 6e-6;
  other[at(Variation::spring_preload)] = -0.04;
  EXPECT_EQ(said_of_mixed(one, one), "");
  EXPECT_EQ(said_of_mixed(other, other), "");
  const std::string said = said_of_mixed(one, other);
  EXPECT_THAT(said, HasSubstr("dry.csv and wet.csv are hardly of one unit: spring_preload is +"));
  EXPECT_THAT(said, HasSubstr("% by the one and -"));
}

TEST(CalibrateUnit, ItsModelIsReadAgainAsItWasWritten) {
  const UnitCalibration unit = UnitFolder({}).calibrate();
  std::ostringstream out;
  model::write_model(out, unit.model);
  const model::Model read = model::parse_model(out.str(), "unit.json");
  ASSERT_TRUE(read.type.has_value());
  EXPECT_EQ(read.type->deviations.size(), variations);
  EXPECT_EQ(read.type->name, type().type->name);
  EXPECT_DOUBLE_EQ(read.type->deviations[at(Variation::spring_rate)].value,
                   unit.model.type->deviations[at(Variation::spring_rate)].value);
  EXPECT_THROW((void)known_of_type(read, "unit.json"), CalibrationError);  // a unit is no type
}

TEST(TypeModel, HoldsUnitsWithinItsTolerancesInAWiderBandOverTheSameTables) {
  const model::Model valve = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  const model::Model made = type_model(valve, tolerances_from({}));
  EXPECT_EQ(made.observer->parameters.spring.curve.values, valve.observer->parameters.spring.curve.values);
  EXPECT_GT(made.observer->parameters.environment.force_N, 0.5);  // some spring and magnet, in newtons
  EXPECT_GT(made.observer->parameters.environment.friction_share, 0.05);
  EXPECT_GT(made.observer->parameters.environment.flow_share, 0.01);
  const KnownDeviations known = known_of_type(made, "type.json");
  EXPECT_NEAR(std::sqrt(known.covariance(1, 1)), 0.015, 1e-12);
  EXPECT_THROW((void)type_model(made, tolerances_from({})), CalibrationError);
}

TEST(TypeModel, BreakAwaysOfAnyUnitAreAsUncertainAsTheTimeInWhichFrictionGrowsAtRest) {
  const sensor::FrictionParameters<double> own =
      model::read_model(SPOOLFLOW_EXAMPLE_MODEL).observer->parameters.friction;
  sensor::FrictionParameters<double> slower = own;
  constexpr double step = 1e-3;
  slower.ageing_s *= std::exp(step);
  double most = 0;
  for (double rest_s = 0.01; rest_s < 100; rest_s *= 1.1)
    most = std::max(most, std::log(sensor::ageing(own, rest_s) / sensor::ageing(slower, rest_s)) / step);
  const double tolerance = all_variations()[at(Variation::ageing_time)].tolerance;
  const double spread = of_hundred_units * most * tolerance;
  EXPECT_NEAR(type().observer->parameters.friction.breakaway_share, std::hypot(own.breakaway_share, spread), 1e-3);
}

TEST(TypeModel, SlidingFrictionOfAnyUnitIsAsUncertainAsItsContactsAgeToo) {
  Deviations alike = tolerances_from({});
  alike[at(Variation::ageing_time)] = 1e-6;
  const model::Model all_age_alike = type_model(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), alike);
  EXPECT_GT(type().observer->parameters.environment.friction_share,
            1.1 * all_age_alike.observer->parameters.environment.friction_share);
  EXPECT_NEAR(type().observer->parameters.environment.force_N, all_age_alike.observer->parameters.environment.force_N,
              1e-6);
}

}  // namespace
}  // namespace spoolflow::calibration
