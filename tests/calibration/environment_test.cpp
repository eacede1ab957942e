/// What a declared machine becomes in a model.
#include "spoolflow/calibration/environment.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

model::Model example() {
  return model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
}

const sensor::Environment<double>& of(const model::Model& model) {
  return model.observer->parameters.environment;
}

TEST(DeclaredMachine, TakesHalfWidthsForTwoStandardDeviationsAndVibrationForASine) {
  model::Model model = example();
  recording::Environment declared;
  declared.position_zero_m = 20e-6;
  declared.position_gain = 0.02;
  declared.density = 0.04;
  declared.vibration_m_per_s2 = 10;
  declared.pwm_ripple = 0.08;
  declared.dithered_loop = 1;
  apply(declared, model);
  EXPECT_DOUBLE_EQ(of(model).dithered_loop_A, 0.5 * model.observer->parameters.actuator.coercive_current_A);
  EXPECT_DOUBLE_EQ(of(model).position_m, 10e-6);
  EXPECT_DOUBLE_EQ(of(model).position_share, 0.01);
  EXPECT_DOUBLE_EQ(of(model).flow_share, 0.01);  // the flow goes with the root of the density
  EXPECT_NEAR(of(model).force_N, model.observer->parameters.moving_mass_kg * 10 / std::sqrt(2), 1e-9);
  EXPECT_NEAR(of(model).current_share, 0.04 / std::sqrt(3), 1e-9);
}

TEST(DeclaredMachine, AnotherViscosityIsAnotherTemperatureOfTheCalibratedOil) {
  model::Model model = example();
  model.fluid.viscosity_40C_m2_per_s = 46e-6;
  model.fluid.viscosity_100C_m2_per_s = 6.8e-6;
  recording::Environment declared;
  declared.viscosity = 46.0 / 32 - 1;  // a class of ISO VG
  apply(declared, model);
  EXPECT_NEAR(2 * of(model).oil_temperature_K, std::log(46.0 / 32) / (std::log(46 / 6.8) / 60), 1e-6);
}

TEST(DeclaredMachine, ReachesTheDeclaredPressureButNeverLessThanTheCalibratedOne) {
  model::Model model = example();
  const double calibrated_Pa = model.observer->parameters.edge.highest_pressure_difference_Pa();
  apply({}, model);
  EXPECT_DOUBLE_EQ(of(model).highest_pressure_Pa, model::usual_highest_pressure_ratio * calibrated_Pa);
  recording::Environment declared;
  declared.highest_Pa = 10e5;
  apply(declared, model);
  EXPECT_DOUBLE_EQ(of(model).highest_pressure_Pa, calibrated_Pa);
}

TEST(DeclaredMachine, LeavesOpenWhatReferencesOfTheValveLeaveOpen) {
  model::Model model = example();
  constexpr double left_open = 0.06;
  model.provenance.adaptations.push_back({});
  model::WearState& wear = model.provenance.adaptations.back().wear.emplace();
  wear.flow_share = wear.friction_share = left_open;
  sensor::Environment<double>& open = model.observer->parameters.environment;
  open.flow_share = open.friction_share = left_open;
  recording::Environment declared;
  declared.density = 0.32;
  declared.friction = 0.16;
  apply(declared, model);
  EXPECT_DOUBLE_EQ(of(model).flow_share, 0.1);  // 6 and 8 %
  EXPECT_DOUBLE_EQ(of(model).friction_share, 0.1);
  apply({}, model);
  EXPECT_DOUBLE_EQ(of(model).flow_share, left_open);
  EXPECT_DOUBLE_EQ(of(model).friction_share, left_open);
}

TEST(DeclaredMachine, IsWrittenWithTheModelAndReadAgain) {
  model::Model model = example();
  apply(recording::machine_environment(), model);
  std::ostringstream text;
  model::write_model(text, model);
  const model::Model again = model::parse_model(text.str(), "model.json");
  EXPECT_DOUBLE_EQ(of(again).oil_temperature_K, of(model).oil_temperature_K);
  EXPECT_DOUBLE_EQ(of(again).leakage_m3_per_s, of(model).leakage_m3_per_s);
}

TEST(CurrentLimits, AreOfVoltageInductanceAndEddyCurrents) {
  model::Model model = example();
  limit_currents(model);
  const sensor::ObserverParameters<double>& valve = model.observer->parameters;
  ASSERT_GT(valve.largest_voltage_V, 0);
  // The example's coil has some 90 mH at least and a supply of 24 V: a quarter to half an ampere in a millisecond.
  EXPECT_GT(valve.current_limits.slope_A_per_s, 200);
  EXPECT_LT(valve.current_limits.slope_A_per_s, 500);
  EXPECT_LT(valve.current_limits.jump_A + valve.current_limits.slope_A_per_s * 1e-3, 0.8);
  model.observer->parameters.largest_voltage_V = 0;
  limit_currents(model);
  EXPECT_EQ(valve.current_limits.jump_A, 0);
}

}  // namespace
}  // namespace spoolflow::calibration
