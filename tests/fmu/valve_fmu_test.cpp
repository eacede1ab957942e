#include "spoolflow/export/valve_fmu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/model/model.hpp"
#include "tests/fmu/description_rules.hpp"
#include "tests/fmu/fmu_instance.hpp"

namespace spoolflow::exports {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ValveFmu : public ::testing::TestWithParam<FmiVersion> {
 protected:
  std::unique_ptr<FmuInstance> begun() {
    auto instance = library.instantiate(log);
    EXPECT_NE(instance, nullptr);
    EXPECT_EQ(instance->enter_initialization(0), FmuStatus::ok);
    EXPECT_EQ(instance->exit_initialization(), FmuStatus::ok);
    return instance;
  }
  /// Opens the valve by `position_m` and runs from `from_s` to `to_s` in steps of a millisecond.
  static void run(FmuInstance& instance, double position_m, int from_ms, int to_ms, double step_s = 1e-3) {
    instance.put("position_set", position_m);
    const long steps = std::lround(1e-3 / step_s);
    for (long k = from_ms * steps; k < to_ms * steps; ++k) {
      ASSERT_EQ(instance.step(static_cast<double>(k) * step_s, step_s), FmuStatus::ok);
    }
  }

  const UnpackedFmu fmu{valve_fmu(rig::valve_preset("size_6"), GetParam(), "0.1.0")};
  const FmuLibrary library{fmu};
  FmuLog log;
};

TEST_P(ValveFmu, KeepsTheRulesOfTheStandard) {
  EXPECT_THAT(description_violations(fmu), IsEmpty());
}

TEST_P(ValveFmu, DeclaresVelocityAndAccelerationAsTheDerivativesThatTheyAre) {
  std::map<std::string, std::string> derivative_of;
  const std::size_t from = GetParam() == FmiVersion::fmi2 ? 1 : 0;  // by place from 1, or by reference
  for (const XmlElement& variable : fmu.variables()) {
    if (variable.has("derivative"))
      derivative_of[variable["name"]] = fmu.variables().at(std::stoul(variable["derivative"]) - from)["name"];
  }
  EXPECT_EQ(derivative_of, (std::map<std::string, std::string>{{"true_velocity", "true_position"},
                                                               {"true_acceleration", "true_velocity"},
                                                               {"cylinder_velocity", "cylinder_position"}}));
  // The trapezoid over samples of 0.1 ms, while the spool crosses most of its stroke.
  auto valve = library.instantiate(log);
  valve->put("sample_step", 1e-4);
  ASSERT_EQ(valve->enter_initialization(0), FmuStatus::ok);
  ASSERT_EQ(valve->exit_initialization(), FmuStatus::ok);
  valve->put("position_set", 1.5e-3);
  double position_m = 0, velocity_m_per_s = 0, fastest_m_per_s = 0, velocity_before = 0, acceleration_before = 0;
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(valve->step(1e-4 * k, 1e-4), FmuStatus::ok);
    position_m += 0.5e-4 * (velocity_before + valve->value("true_velocity"));
    velocity_m_per_s += 0.5e-4 * (acceleration_before + valve->value("true_acceleration"));
    velocity_before = valve->value("true_velocity"), acceleration_before = valve->value("true_acceleration");
    fastest_m_per_s = std::max(fastest_m_per_s, velocity_before);
    ASSERT_NEAR(velocity_m_per_s, velocity_before, 0.02) << k;
  }
  EXPECT_GT(fastest_m_per_s, 0.04);
  EXPECT_GT(valve->value("true_position"), 1e-3);
  EXPECT_NEAR(position_m, valve->value("true_position"), 5e-6);
}

TEST_P(ValveFmu, RefusesASetPositionInMetresThatWasMeantInMillimetres) {
  const auto valve = begun();
  valve->put("position_set", 1.0);
  EXPECT_EQ(valve->step(0, 1e-3), FmuStatus::discard);
  EXPECT_THAT(log.messages, Contains(HasSubstr("position_set = 1 is outside")));
  valve->put("position_set", 1e-3);
  EXPECT_EQ(valve->step(0, 1e-3), FmuStatus::ok);
}

TEST_P(ValveFmu, OpensToItsSetPositionAndLetsOilThrough) {
  const auto valve = begun();
  EXPECT_NEAR(valve->value("flow"), 0, 1e-5);
  run(*valve, 1.2e-3, 0, 400);
  EXPECT_NEAR(valve->value("true_position"), 1.2e-3, 0.1e-3);  // the loop closes the last of it slowly
  EXPECT_NEAR(valve->value("position"), valve->value("true_position"), 20e-6);
  EXPECT_NEAR(valve->value("pressure_difference"), 50e5, 3e5);
  EXPECT_GT(valve->value("flow"), 10.0 / 60000);
  EXPECT_GT(valve->value("current"), 0.3);
  EXPECT_NEAR(valve->value("oil_temperature"), 323.15, 0.5);
}

TEST_P(ValveFmu, RepeatsItselfAfterAResetFromAStateAndWhateverTheCommunicationStep) {
  const auto valve = begun();
  run(*valve, 1.0e-3, 0, 100);
  const std::vector<char> state = valve->state();
  run(*valve, 0.4e-3, 100, 150);
  const double flow = valve->value("flow");
  ASSERT_EQ(valve->set_state(state), FmuStatus::ok);
  run(*valve, 0.4e-3, 100, 150);
  EXPECT_EQ(valve->value("flow"), flow);
  ASSERT_EQ(valve->reset(), FmuStatus::ok);
  ASSERT_EQ(valve->enter_initialization(0), FmuStatus::ok);
  ASSERT_EQ(valve->exit_initialization(), FmuStatus::ok);
  run(*valve, 1.0e-3, 0, 100, 0.5e-3);
  run(*valve, 0.4e-3, 100, 150, 0.1e-3);
  EXPECT_EQ(valve->value("flow"), flow);
}

TEST_P(ValveFmu, ComesAndGoesAHundredTimes) {
  double first = 0;
  for (int k = 0; k < 100; ++k) {
    const FmuLibrary again(fmu);
    const auto valve = again.instantiate(log);
    ASSERT_EQ(valve->enter_initialization(0), FmuStatus::ok);
    ASSERT_EQ(valve->exit_initialization(), FmuStatus::ok);
    run(*valve, 1.0e-3, 0, 3);
    if (k == 0) first = valve->value("current");
    ASSERT_EQ(valve->value("current"), first) << k;
  }
}

TEST_P(ValveFmu, DiscardsAStepWithAnInputThatIsNoNumber) {
  const auto valve = begun();
  run(*valve, 1.0e-3, 0, 20);
  const double current = valve->value("current");
  valve->put("position_set", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(valve->step(0.020, 1e-3), FmuStatus::discard);
  EXPECT_THAT(log.messages, Contains(HasSubstr("position_set")));
  EXPECT_EQ(valve->value("current"), current);
  run(*valve, 1.0e-3, 20, 30);
  EXPECT_TRUE(std::isfinite(valve->value("flow")));
}

TEST_P(ValveFmu, DiscardsAStepWithAnInputThatNoPlantHasAndGoesOn) {
  const auto valve = begun();
  run(*valve, 1.0e-3, 0, 20);
  const double flow = valve->value("flow");
  valve->put("ambient_temperature", 25);  // meant as degC
  EXPECT_EQ(valve->step(0.020, 1e-3), FmuStatus::discard);
  EXPECT_THAT(log.messages, Contains(HasSubstr("ambient_temperature = 25 is outside 233.15 to 423.15 K")));
  valve->put("ambient_temperature", 298.15);
  valve->put("pressure_difference_set", 1e300);
  EXPECT_EQ(valve->step(0.020, 1e-3), FmuStatus::discard);
  EXPECT_EQ(valve->value("flow"), flow);
  valve->put("pressure_difference_set", 5e6);
  run(*valve, 1.0e-3, 20, 30);
  EXPECT_TRUE(std::isfinite(valve->value("flow")));
}

TEST_P(ValveFmu, FeedsTheSensorsFmu) {
  // The sensor was calibrated on another valve of this size: the coupling is under test here, not the accuracy.
  const UnpackedFmu sensor_fmu(sensor_fmu_of_example(GetParam()));
  const FmuLibrary sensor_library(sensor_fmu);
  const auto sensor = sensor_library.instantiate(log);
  const auto valve = begun();
  ASSERT_EQ(sensor->enter_initialization(0), FmuStatus::ok);
  ASSERT_EQ(sensor->exit_initialization(), FmuStatus::ok);
  for (int k = 0; k < 1500; ++k) {
    const double time_s = 1e-3 * k;
    valve->put("position_set", k < 1000 ? 1.6e-6 * k : 1.6e-3);
    for (const char* signal : {"current", "voltage", "position", "oil_temperature"}) {
      sensor->put(signal, valve->value(signal));
    }
    ASSERT_EQ(valve->step(time_s, 1e-3), FmuStatus::ok);
    ASSERT_EQ(sensor->step(time_s, 1e-3), FmuStatus::ok);
  }
  EXPECT_GT(sensor->value("flow"), 0.3 * valve->value("flow"));
  EXPECT_LT(sensor->value("flow"), 3.0 * valve->value("flow"));
  EXPECT_EQ(sensor->status_bits() & static_cast<int>(sensor::Status::sample_missing), 0);
}

INSTANTIATE_TEST_SUITE_P(By, ValveFmu, ::testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& version) { return version.param == FmiVersion::fmi2 ? "Fmi2" : "Fmi3"; });

}  // namespace
}  // namespace spoolflow::exports
