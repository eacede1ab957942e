/// What the fits say of their own parameters.
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(FittedParameters, UncertaintiesAndCorrelationsAreThoseOfTheCovariance) {
  Eigen::MatrixXd covariance(3, 3);
  covariance << 4, -3, 0, -3, 9, 0, 0, 0, 0;
  const model::Fit fit = known_from("a line", {"offset_N", "slope_N_per_m", "held_N"}, {10, -2, 0}, covariance);
  EXPECT_EQ(fit.parameters[0].uncertainty, 2);
  EXPECT_EQ(fit.parameters[1].uncertainty, 3);
  EXPECT_EQ(fit.parameters[2].uncertainty, 0);
  EXPECT_THAT(fit.correlation, ElementsAre(1, DoubleEq(-0.5), 0, DoubleEq(-0.5), 1, 0, 0, 0, 1));
}

class ExampleFits : public ::testing::Test {
 protected:
  [[nodiscard]] const model::Fit& fit(const std::string& beginning) const {
    for (const model::Fit& each : model.observer->fits)
      if (each.of.starts_with(beginning)) return each;
    throw std::runtime_error("the example has no fit of " + beginning);
  }

  model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
};

TEST_F(ExampleFits, EveryCorrelationLiesWithinOneAndIsTheSameBothWays) {
  ASSERT_GE(model.observer->fits.size(), 8U);
  for (const model::Fit& fit : model.observer->fits) {
    const std::size_t n = fit.parameters.size();
    ASSERT_EQ(fit.correlation.size(), n * n) << fit.of;
    for (std::size_t r = 0; r < n; ++r) {
      EXPECT_EQ(fit.correlation[r * n + r], 1) << fit.of;
      for (std::size_t c = 0; c < n; ++c) {
        EXPECT_LE(std::abs(fit.correlation[r * n + c]), 1) << fit.of;
        EXPECT_NEAR(fit.correlation[r * n + c], fit.correlation[c * n + r], 1e-9) << fit.of;
      }
    }
  }
}

TEST_F(ExampleFits, KnowTheCoilResistanceToAPercent) {
  const model::FittedParameter& resistance = fit("coil resistance").parameters.front();
  EXPECT_EQ(resistance.name, "coil_resistance_Ohm");
  EXPECT_NEAR(resistance.value, model.observer->parameters.actuator.coil_resistance.resistance_Ohm, 1e-9);
  EXPECT_GT(resistance.uncertainty, 0);
  EXPECT_LT(resistance.uncertainty, 0.01 * resistance.value);
}

TEST_F(ExampleFits, SpringsLineFollowsTheSpringsCurve) {
  const sensor::Spring<double>& spring = model.observer->parameters.spring;
  const model::Fit& line = fit("spring");
  const double half_m = 0.5 * model.valve.stroke_m;
  EXPECT_NEAR(line.parameters[0].value + line.parameters[1].value * half_m, spring.at(half_m).value, 1);
  EXPECT_NEAR(line.parameters[1].value, spring.at(half_m).slope, 0.1 * line.parameters[1].value);
  EXPECT_GT(line.parameters[1].uncertainty, 0);
}

TEST_F(ExampleFits, FlowForceGrowsWithPressureAsTheMapSays) {
  const model::Fit& law = fit("flow force");
  const auto& edge = model.observer->parameters.edge;
  const double open_m = 0.75 * model.valve.stroke_m;
  const double pressure_Pa = 0.5 * edge.highest_pressure_difference_Pa();
  EXPECT_NEAR(law.parameters[0].value * pressure_Pa, edge.at(323.15, pressure_Pa, open_m).flow_force_N,
              0.05 * law.parameters[0].value * pressure_Pa);
  EXPECT_LT(law.parameters[0].uncertainty, 0.02 * law.parameters[0].value);
}

TEST_F(ExampleFits, OperationStatesItsParametersWithTheirUncertainty) {
  const model::Fit& known = fit("friction and position sensor in operation");
  ASSERT_EQ(known.parameters.size(), 8U);
  EXPECT_EQ(known.parameters[0].name, "operation_friction_ratio");
  EXPECT_EQ(known.parameters[0].value, model.observer->parameters.friction.operation_ratio);
  EXPECT_GT(known.parameters[0].uncertainty, 0);
  EXPECT_LT(known.parameters[0].uncertainty, 0.2);
}

TEST_F(ExampleFits, ModelLeavesLittleOfTheBenchThatTheMapsWereMadeOf) {
  ASSERT_FALSE(model.evidence.bench.axial_force.empty());
  for (const model::MapResidual& strokes : model.evidence.bench.axial_force)
    for (const double mean_N : strokes.mean_N) EXPECT_LT(std::abs(mean_N), 0.5) << strokes.held;
  ASSERT_FALSE(model.evidence.bench.solenoid.empty());
  double model_N2 = 0, map_N2 = 0;
  for (const model::SolenoidTrace& trace : model.evidence.bench.solenoid) {
    for (std::size_t k = 0; k < trace.current_A.size(); ++k) {
      model_N2 += std::pow(trace.measured_N[k] - trace.model_N[k], 2);
      map_N2 += std::pow(trace.measured_N[k] - trace.map_N[k], 2);
    }
  }
  EXPECT_LT(model_N2, 0.2 * map_N2);
}

TEST_F(ExampleFits, ComeBackFromTheModelFileAndAWrongSizeIsRefusedAtItsPlace) {
  std::ostringstream written;
  model::write_model(written, model);
  const model::Model again = model::parse_model(written.str(), "model.json");
  ASSERT_EQ(again.observer->fits.size(), model.observer->fits.size());
  EXPECT_EQ(again.observer->fits[1].correlation, model.observer->fits[1].correlation);
  EXPECT_EQ(again.observer->fits[1].parameters[1].name, model.observer->fits[1].parameters[1].name);
  ASSERT_EQ(again.evidence.bench.solenoid.size(), model.evidence.bench.solenoid.size());
  EXPECT_EQ(again.evidence.bench.solenoid[0].model_N, model.evidence.bench.solenoid[0].model_N);
  ASSERT_EQ(again.evidence.bench.axial_force.size(), model.evidence.bench.axial_force.size());
  EXPECT_EQ(again.evidence.bench.axial_force[0].rms_N, model.evidence.bench.axial_force[0].rms_N);

  model.observer->fits[0].correlation.pop_back();
  std::ostringstream damaged;
  model::write_model(damaged, model);
  EXPECT_THAT([&] { (void)model::parse_model(damaged.str(), "model.json"); },
              ::testing::ThrowsMessage<model::ModelError>(
                  HasSubstr("/observer/fits/0/correlation: has 8 entries, 9 would fit")));
}

}  // namespace
}  // namespace spoolflow::calibration
