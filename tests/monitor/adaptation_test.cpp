#include "spoolflow/monitor/adaptation.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/monitor/example.hpp"

namespace spoolflow::monitor {
namespace {

using testing::HasSubstr;

const sensor::ObserverParameters<double>& sound() {
  return example().observer->parameters;
}

sensor::ObserverParameters<double> changed(const Difference& difference) {
  sensor::ObserverParameters<double> out = sound();
  apply(difference, example().valve.stroke_m, out);
  return out;
}

constexpr double half_open_m = 1.1e-3;

TEST(Correction, MoreFrictionHoldsSpoolAndArmatureInProportion) {
  const auto worn = changed({.friction_ratio = 1.5});
  const auto friction_N = [](const auto& of) { return of.edge.at(323, 50e5, half_open_m).friction_N; };
  EXPECT_NEAR(friction_N(worn), 1.5 * friction_N(sound()), 1e-9);
  const auto armature_N = [](const auto& of) { return of.actuator.friction_N.at(1.2, half_open_m).value; };
  EXPECT_NEAR(armature_N(worn), 1.5 * armature_N(sound()), 1e-9);
}

TEST(Correction, AWeakerSpringPushesLessByItsShares) {
  const auto weak = changed({.preload_loss = 0.1, .rate_loss = 0.05});
  const double stroke_m = example().valve.stroke_m;
  const double preload_N = sound().spring.at(0).value, whole_N = sound().spring.at(stroke_m).value;
  EXPECT_NEAR(weak.spring.at(0).value, 0.9 * preload_N, 1e-9);
  EXPECT_NEAR(weak.spring.at(stroke_m).value, whole_N - 0.1 * preload_N - 0.05 * (whole_N - preload_N), 1e-3);
}

TEST(Correction, ShortedTurnsTakeThatMuchMoreCurrentForTheSameForceAndGiveLessFluxLinkage) {
  const double left = 0.96;
  const auto shorted = changed({.shorted_turns = 1 - left});
  const auto force_N = [](const auto& of, double current_A) {
    return of.actuator.magnetic_force.at(current_A, half_open_m).value;
  };
  const auto flux_Wb = [](const auto& of, double current_A) {
    return of.actuator.coil.flux_linkage.map.at(current_A, half_open_m).value;
  };
  EXPECT_NEAR(force_N(shorted, 1.3 / left), force_N(sound(), 1.3), 1e-9);
  EXPECT_NEAR(flux_Wb(shorted, 1.3 / left), left * flux_Wb(sound(), 1.3), 1e-12);
  EXPECT_NEAR(shorted.actuator.coil_resistance.resistance_Ohm, left * sound().actuator.coil_resistance.resistance_Ohm,
              1e-12);
  EXPECT_GT(shorted.actuator.coil.eddy_currents.classical_A_per_V,
            sound().actuator.coil.eddy_currents.classical_A_per_V);
}

TEST(Correction, AShiftedSensorReadsTheSameForcesThatMuchFurther) {
  const double zero_m = 25e-6;
  const auto shifted = changed({.position_zero_m = zero_m});
  const double at_m = half_open_m + zero_m;
  EXPECT_NEAR(shifted.spring.at(at_m).value, sound().spring.at(half_open_m).value, 1e-9);
  EXPECT_NEAR(shifted.edge.at(323, 50e5, at_m).conductance, sound().edge.at(323, 50e5, half_open_m).conductance, 1e-12);
  EXPECT_NEAR(shifted.actuator.magnetic_force.at(1, at_m).value,
              sound().actuator.magnetic_force.at(1, half_open_m).value, 1e-9);
  EXPECT_NEAR(closed_stop_m(shifted) - closed_stop_m(sound()), zero_m, 1e-12);
  sensor::CondensedParameters<double> condensed = example().condensed.parameters;
  apply({.position_zero_m = zero_m}, example().valve.stroke_m, condensed);
  EXPECT_NEAR(condensed.spring.at(at_m).value, example().condensed.parameters.spring.at(half_open_m).value, 0.02);
}

Findings found(Fault fault, const Magnitudes& value) {
  Findings out;
  out.side[0].raised = true;
  out.side[0].likeliest[static_cast<std::size_t>(fault)] = true;
  out.side[0].value = value;
  out.side[0].deviation.fill(0.1);
  return out;
}

model::Adaptation how() {
  return {"1.2.3", "2026-01-02T03:04:05Z", std::string(64, 'a'), {"monday.csv"}, {}};
}

std::string refusal(const Findings& findings) {
  try {
    static_cast<void>(adapted(example(), findings, how()));
  } catch (const model::ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(Adaptation, CorrectsWhatIsRaisedAndNothingElse) {
  const model::Model corrected = adapted(example(), found(Fault::spring, {0.9, 0.9, 1, 1, 0.9, 0.9}), how());
  const auto& valve = corrected.observer->parameters;
  EXPECT_LT(valve.spring.at(0).value, sound().spring.at(0).value);
  EXPECT_EQ(valve.edge.friction_N.values, sound().edge.friction_N.values);
  EXPECT_EQ(closed_stop_m(valve), closed_stop_m(sound()));
  EXPECT_EQ(valve.actuator.magnetic_force.map.row_axis.spacing, sound().actuator.magnetic_force.map.row_axis.spacing);
}

TEST(Adaptation, ReadsBackWithWhatWasCorrectedByHowMuchFromWhatAndByWhom) {
  const model::Model corrected = adapted(example(), found(Fault::coil, {0, 0, 0, 0, 1, 0}), how());
  std::ostringstream text;
  model::write_model(text, corrected);
  const model::Model read = model::parse_model(text.str(), "corrected.json");
  ASSERT_EQ(read.provenance.adaptations.size(), 1U);
  const model::Adaptation& adaptation = read.provenance.adaptations.front();
  EXPECT_EQ(adaptation.tool_version, "1.2.3");
  EXPECT_EQ(adaptation.adapted_from, std::string(64, 'a'));
  EXPECT_EQ(adaptation.files, std::vector<std::string>{"monday.csv"});
  ASSERT_EQ(adaptation.corrections.size(), 1U);
  EXPECT_EQ(adaptation.corrections.front().of, "shorted turns");
  EXPECT_NEAR(adaptation.corrections.front().value, 0.04, 1e-12);
  EXPECT_NEAR(adaptation.corrections.front().uncertainty_95, 2 * 0.1 * 0.04, 1e-12);
  EXPECT_NEAR(read.observer->parameters.actuator.magnetic_force.map.row_axis.spacing,
              sound().actuator.magnetic_force.map.row_axis.spacing / 0.96, 1e-12);
}

TEST(Adaptation, RefusesWhereNothingIsRaised) {
  EXPECT_THAT(refusal({}), HasSubstr("nothing to correct"));
}

TEST(Adaptation, RefusesMoreThanItsLimitsAndNamesThem) {
  EXPECT_THAT(refusal(found(Fault::friction, {6, 0, 0, 0, 0, 0})), HasSubstr("friction ratio 3.4"));
  EXPECT_THAT(refusal(found(Fault::position_sensor, {0, 0, 0, 0, 0, 3})), HasSubstr("position zero"));
  EXPECT_EQ(refusal(found(Fault::friction, {4, 0, 0, 0, 0, 0})), "");
}

TEST(Adaptation, WornEdgesAreNotCorrected) {
  EXPECT_THAT(refusal(found(Fault::edge_wear, {0, 1, 0, 0, 0, 0})), HasSubstr("edge wear"));
}

}  // namespace
}  // namespace spoolflow::monitor
