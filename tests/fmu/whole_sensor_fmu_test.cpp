/// The FMU of a whole valve's sensor: both coils in, signed flow out.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/export/sensor_fmu.hpp"
#include "spoolflow/export/valve_fmu.hpp"
#include "tests/fmu/description_rules.hpp"
#include "tests/fmu/fmu_instance.hpp"

namespace spoolflow::exports {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class WholeSensorFmu : public ::testing::TestWithParam<FmiVersion> {
 protected:
  static std::unique_ptr<FmuInstance> begun(const FmuLibrary& library, FmuLog& log) {
    auto instance = library.instantiate(log);
    EXPECT_NE(instance, nullptr);
    EXPECT_EQ(instance->enter_initialization(0), FmuStatus::ok);
    EXPECT_EQ(instance->exit_initialization(), FmuStatus::ok);
    return instance;
  }
  /// A spool that swings through the centre, its currents with it; made up.
  static estimation::TimedWholeSample swinging(int k) {
    const double swing = std::sin(0.002 * k);
    const double current_b_A = swing > 0 ? 1.6 * swing : 0.0;
    const double current_a_A = swing < 0 ? -1.6 * swing : 0.0;
    return {1e-3 * k, current_a_A, current_b_A, 3 * current_a_A, 3 * current_b_A, 1.9e-3 * swing, 318.0};
  }
  static void put(FmuInstance& instance, const estimation::TimedWholeSample& in) {
    instance.put("current_a", in.current_a_A);
    instance.put("current_b", in.current_b_A);
    instance.put("voltage_a", in.voltage_a_V);
    instance.put("voltage_b", in.voltage_b_V);
    instance.put("position", in.position_m);
    instance.put("oil_temperature", in.oil_temperature_K);
  }

  const model::Model model = whole_example();
  const UnpackedFmu fmu{sensor_fmu(model, GetParam(), "0.1.0")};
  const FmuLibrary library{fmu};
  FmuLog log;
};

TEST_P(WholeSensorFmu, KeepsTheRulesOfTheStandardAndSaysWhatItIs) {
  EXPECT_THAT(description_violations(fmu), IsEmpty());
  EXPECT_THAT(fmu.description().front()["description"], HasSubstr("whole 4/3 valve"));
  EXPECT_THAT(fmu.content("documentation/index.html"), HasSubstr("solenoid a opens P to A"));
}

TEST_P(WholeSensorFmu, ReadsPortPressuresWhereTheyAreSaidToBeMeasured) {
  const auto plain = begun(library, log);
  const auto with = library.instantiate(log);
  ASSERT_EQ(with->set_flag(fmu.reference("use_port_pressures"), true), FmuStatus::ok);
  ASSERT_EQ(with->enter_initialization(0), FmuStatus::ok);
  ASSERT_EQ(with->exit_initialization(), FmuStatus::ok);
  for (int k = 0; k < 700; ++k) {
    for (FmuInstance* const instance : {plain.get(), with.get()}) {
      put(*instance, swinging(k));
      instance->put("pressure_p", 50e5);
      instance->put("pressure_a", 2e5);
      instance->put("pressure_b", 70e5);  // a load drives the oil back into the supply
      instance->put("pressure_t", 1e5);
      ASSERT_EQ(instance->step(1e-3 * k, 1e-3), FmuStatus::ok);
    }
  }
  EXPECT_GT(plain->value("flow"), 0);
  EXPECT_LT(with->value("flow_upper"), 0);
}

TEST_P(WholeSensorFmu, AnswersWithSignedFlowAsEstimateDoes) {
  for (const auto estimator : {estimation::Estimator::observer, estimation::Estimator::condensed}) {
    model::Model own = model;
    if (estimator == estimation::Estimator::condensed) own.p_to_a->observer.reset();
    const UnpackedFmu own_fmu(sensor_fmu(own, GetParam(), "0.1.0"));
    const FmuLibrary own_library(own_fmu);
    const auto instance = begun(own_library, log);
    estimation::RunningSensor sensor = estimation::running_sensor(own, estimator);
    double most = 0, least = 0;
    for (int k = 0; k < 6300; ++k) {
      put(*instance, swinging(k));
      ASSERT_EQ(instance->step(1e-3 * k, 1e-3), FmuStatus::ok);
      const auto expected = sensor.step(estimation::of_both_coils(swinging(k)));
      const double tolerance = 1e-6 * model.valve.rated_flow_m3_per_s;
      ASSERT_NEAR(instance->value("flow"), expected.flow_m3_per_s, tolerance) << k;
      ASSERT_NEAR(instance->value("flow_lower"), expected.flow_lower_m3_per_s, tolerance) << k;
      ASSERT_NEAR(instance->value("flow_upper"), expected.flow_upper_m3_per_s, tolerance) << k;
      ASSERT_EQ(instance->status_bits(), static_cast<int>(expected.status)) << k;
      most = std::max(most, instance->value("flow"));
      least = std::min(least, instance->value("flow"));
    }
    EXPECT_GT(most, 0.1 * model.valve.rated_flow_m3_per_s);
    EXPECT_LT(least, -0.1 * model.valve.rated_flow_m3_per_s);
  }
}

TEST_P(WholeSensorFmu, HoldsItsAnswerWhereEitherCurrentIsMissing) {
  const auto instance = begun(library, log);
  for (int k = 0; k < 600; ++k) {
    put(*instance, swinging(k));
    ASSERT_EQ(instance->step(1e-3 * k, 1e-3), FmuStatus::ok);
  }
  const double before = instance->value("flow");
  for (const char* current : {"current_a", "current_b"}) {
    const int k = current == std::string("current_a") ? 600 : 601;
    put(*instance, swinging(k));
    instance->put(current, std::numeric_limits<double>::quiet_NaN());
    ASSERT_EQ(instance->step(1e-3 * k, 1e-3), FmuStatus::ok);
    EXPECT_EQ(instance->value("flow"), before);
    EXPECT_EQ(instance->status_bits(), static_cast<int>(sensor::Status::sample_missing));
  }
}

TEST_P(WholeSensorFmu, LetsEachDirectionBeTuned) {
  const auto tuned = begun(library, log), untouched = begun(library, log);
  tuned->put("a.filter.band_coverage", 2.5);
  const auto width = [](FmuInstance& instance) { return instance.value("flow_upper") - instance.value("flow_lower"); };
  for (int k = 0; k < 2500; ++k) {
    for (FmuInstance* instance : {tuned.get(), untouched.get()}) {
      put(*instance, swinging(k));
      ASSERT_EQ(instance->step(1e-3 * k, 1e-3), FmuStatus::ok);
    }
    if (k == 800) {
      EXPECT_EQ(width(*tuned), width(*untouched));
    }
  }
  EXPECT_GT(width(*tuned), width(*untouched));
  EXPECT_EQ(tuned->set(fmu.reference("b.filter.band_coverage"), -1), FmuStatus::error);
}

TEST_P(WholeSensorFmu, FollowsTheVirtualValveToBothSides) {
  // The sensor was calibrated on another valve of this size: the coupling is under test here, not the accuracy.
  const UnpackedFmu valve_of_rig(valve_fmu(rig::valve_preset("size_6"), GetParam(), "0.1.0"));
  const FmuLibrary valve_library(valve_of_rig);
  const auto sensor = begun(library, log);
  const auto valve = begun(valve_library, log);
  for (const double position_m : {1.5e-3, -1.5e-3}) {
    const int first = position_m > 0 ? 0 : 1500;
    for (int k = 0; k < 1500; ++k) {
      const double time_s = 1e-3 * (first + k);
      valve->put("position_set", position_m * std::min(1.0, 1e-3 * k));
      for (const char* signal : {"current_a", "current_b", "voltage_a", "voltage_b", "position", "oil_temperature"}) {
        sensor->put(signal, valve->value(signal));
      }
      ASSERT_EQ(valve->step(time_s, 1e-3), FmuStatus::ok);
      ASSERT_EQ(sensor->step(time_s, 1e-3), FmuStatus::ok);
    }
    const double true_flow = valve->value("flow");
    EXPECT_GT(true_flow * position_m, 0);
    EXPECT_GT(sensor->value("flow") / true_flow, 0.3) << position_m;
    EXPECT_LT(sensor->value("flow") / true_flow, 3.0) << position_m;
    EXPECT_GT(valve->value(position_m > 0 ? "current_b" : "current_a"), 0.3);
    EXPECT_NEAR(valve->value(position_m > 0 ? "current_a" : "current_b"), 0, 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(By, WholeSensorFmu, ::testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& version) { return version.param == FmiVersion::fmi2 ? "Fmi2" : "Fmi3"; });

}  // namespace
}  // namespace spoolflow::exports
