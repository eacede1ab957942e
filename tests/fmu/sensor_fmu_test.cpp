#include "spoolflow/export/sensor_fmu.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "tests/fmu/fmu_instance.hpp"

namespace spoolflow::exports {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double full_scale_m3_per_s = 80.0 / 60000;

/// A recording of the examples in SI units, one row a millisecond.
struct Rows {
  std::vector<double> current_A, voltage_V, position_m, temperature_K;
  std::vector<sensor::Estimate<double>> estimates;  ///< what `estimate` says of them
};

Rows example_rows(std::size_t count) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  const auto reader = recording::open_reader(SPOOLFLOW_SOURCES "/examples/valve_a/duty_cycle_1.h5",
                                             estimation::sensor_channels(model, {}));
  estimation::RunningSensor sensor = estimation::running_sensor(model, estimation::Estimator::observer);
  Rows rows;
  recording::SampleBlock block;
  std::vector<sensor::Estimate<double>> estimates;
  while (rows.estimates.size() < count && reader->next(block)) {
    estimates.resize(block.rows);
    estimation::run(sensor, estimation::sensor_columns(block), estimates);
    const auto append = [&](std::vector<double>& to, recording::Channel channel) {
      const auto& from = block.columns[static_cast<std::size_t>(channel)];
      to.insert(to.end(), from.begin(), from.end());
    };
    append(rows.current_A, recording::Channel::current);
    append(rows.voltage_V, recording::Channel::voltage);
    append(rows.position_m, recording::Channel::position);
    append(rows.temperature_K, recording::Channel::oil_temperature);
    rows.estimates.insert(rows.estimates.end(), estimates.begin(), estimates.end());
  }
  return rows;
}

class SensorFmu : public ::testing::TestWithParam<FmiVersion> {
 protected:
  static const Rows& rows() {
    static const Rows all = example_rows(12000);
    return all;
  }
  void put_row(FmuInstance& instance, std::size_t k) const {
    instance.put("current", rows().current_A[k]);
    instance.put("voltage", rows().voltage_V[k]);
    instance.put("position", rows().position_m[k]);
    instance.put("oil_temperature", rows().temperature_K[k]);
  }
  std::unique_ptr<FmuInstance> begun(double start_s = 0) {
    auto instance = library.instantiate(log);
    EXPECT_NE(instance, nullptr);
    begin(*instance, start_s);
    return instance;
  }
  static void begin(FmuInstance& instance, double start_s = 0) {
    EXPECT_EQ(instance.enter_initialization(start_s), FmuStatus::ok);
    EXPECT_EQ(instance.exit_initialization(), FmuStatus::ok);
  }
  /// Flows of `count` rows from row `from`, a communication step each.
  std::vector<double> run(FmuInstance& instance, std::size_t from, std::size_t count, double start_s = 0) {
    std::vector<double> flow;
    for (std::size_t k = from; k < from + count; ++k) {
      put_row(instance, k);
      EXPECT_EQ(instance.step(start_s + static_cast<double>(k) * 1e-3, 1e-3), FmuStatus::ok);
      flow.push_back(instance.value("flow"));
    }
    return flow;
  }

  const UnpackedFmu fmu{sensor_fmu_of_example(GetParam())};
  const FmuLibrary library{fmu};
  FmuLog log;
};

TEST_P(SensorFmu, AnswersAsEstimateDoesOnTheSameRecording) {
  const auto instance = begun();
  const std::size_t count = rows().estimates.size();
  for (std::size_t k = 0; k < count; ++k) {
    put_row(*instance, k);
    ASSERT_EQ(instance->step(static_cast<double>(k) * 1e-3, 1e-3), FmuStatus::ok);
    const sensor::Estimate<double>& expected = rows().estimates[k];
    ASSERT_NEAR(instance->value("flow"), expected.flow_m3_per_s, 1e-6 * full_scale_m3_per_s) << k;
    ASSERT_NEAR(instance->value("flow_lower"), expected.flow_lower_m3_per_s, 1e-6 * full_scale_m3_per_s) << k;
    ASSERT_NEAR(instance->value("flow_upper"), expected.flow_upper_m3_per_s, 1e-6 * full_scale_m3_per_s) << k;
    ASSERT_EQ(instance->status_bits(), static_cast<int>(expected.status)) << k;
  }
  EXPECT_GE(count, 12000u);
  EXPECT_EQ(instance->terminate(), FmuStatus::ok);
}

TEST_P(SensorFmu, GivesTheAnswerToItsStartValuesAfterInitialization) {
  const auto instance = library.instantiate(log);
  ASSERT_EQ(instance->enter_initialization(0), FmuStatus::ok);
  put_row(*instance, 0);
  EXPECT_NEAR(instance->value("flow"), rows().estimates[0].flow_m3_per_s, 1e-6 * full_scale_m3_per_s);
  ASSERT_EQ(instance->exit_initialization(), FmuStatus::ok);
  EXPECT_NEAR(instance->value("flow"), rows().estimates[0].flow_m3_per_s, 1e-6 * full_scale_m3_per_s);
  // That look ahead is no sample: the run goes on as if it had not been.
  const auto other = begun();
  EXPECT_EQ(run(*instance, 0, 500), run(*other, 0, 500));
}

TEST_P(SensorFmu, DoesNotDependOnHowTimeIsCutIntoSteps) {
  // Inputs that change every 20 ms; communication steps of 0.25 ms to 20 ms, whole samples and parts of them.
  std::map<double, std::vector<double>> flows;
  for (const double step_s : {20e-3, 4e-3, 2.5e-3, 1e-3, 0.25e-3}) {
    const auto instance = begun(3.0);
    const long steps = std::lround(20e-3 / step_s);
    for (long k = 0; k < 60; ++k) {
      put_row(*instance, static_cast<std::size_t>(40 * k));
      for (long part = 0; part < steps; ++part) {
        const double time_s = 3.0 + 20e-3 * static_cast<double>(k) + step_s * static_cast<double>(part);
        ASSERT_EQ(instance->step(time_s, step_s), FmuStatus::ok);
      }
      flows[step_s].push_back(instance->value("flow"));
    }
  }
  for (const auto& [step_s, flow] : flows) EXPECT_EQ(flow, flows[1e-3]) << step_s;
}

TEST_P(SensorFmu, ComesAndGoesAHundredTimesAndStartsAfreshEachTime) {
  const std::vector<double> expected = run(*begun(), 0, 20);
  for (int k = 0; k < 100; ++k) {
    const FmuLibrary again(fmu);
    const auto instance = again.instantiate(log);
    begin(*instance);
    ASSERT_EQ(run(*instance, 0, 20), expected) << k;
  }
}

TEST_P(SensorFmu, IsAsNewAfterAReset) {
  const auto instance = begun();
  instance->put("limit.current", 1.0);
  const std::vector<double> used = run(*instance, 0, 2000);
  EXPECT_EQ(instance->reset(), FmuStatus::ok);
  const auto fresh = library.instantiate(log);
  for (const char* name : {"current", "flow", "limit.current"}) EXPECT_EQ(instance->value(name), fresh->value(name));
  begin(*instance);
  begin(*fresh);
  EXPECT_EQ(run(*instance, 0, 2000), run(*fresh, 0, 2000));
}

TEST_P(SensorFmu, GoesOnFromASerializedStateInAnotherInstance) {
  const auto instance = begun();
  (void)run(*instance, 0, 1500);
  const std::vector<char> state = instance->state();
  ASSERT_FALSE(state.empty());
  const std::vector<double> expected = run(*instance, 1500, 1000);
  ASSERT_EQ(instance->set_state(state), FmuStatus::ok);
  EXPECT_EQ(run(*instance, 1500, 1000), expected);
  const auto other = begun();
  ASSERT_EQ(other->set_state(state), FmuStatus::ok);
  EXPECT_EQ(other->state(), state);
  EXPECT_EQ(run(*other, 1500, 1000), expected);
}

TEST_P(SensorFmu, RefusesADamagedState) {
  const auto instance = begun();
  std::vector<char> state = instance->state();
  state[state.size() / 2] = static_cast<char>(state[state.size() / 2] ^ 4);
  EXPECT_EQ(instance->set_state(state), FmuStatus::error);
  state.resize(10);
  EXPECT_EQ(instance->set_state(state), FmuStatus::error);
  EXPECT_THAT(log.messages, AllOf(Contains(HasSubstr("checksum")), Contains(HasSubstr("too few"))));
}

TEST_P(SensorFmu, RunsManyInstancesAtOnce) {
  const std::vector<double> expected = run(*begun(), 0, 1000);
  std::vector<std::vector<double>> got(4);
  std::vector<std::thread> threads;
  for (auto& flow : got) {
    threads.emplace_back([&] {
      FmuLog own;
      const auto instance = library.instantiate(own);
      begin(*instance);
      flow = run(*instance, 0, 1000);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& flow : got) EXPECT_EQ(flow, expected);
}

TEST_P(SensorFmu, SaysThatInputsAreMissingAndRecovers) {
  const auto instance = begun();
  const double before = run(*instance, 0, 3000).back();
  for (std::size_t k = 3000; k < 3050; ++k) {
    instance->put("current", std::numeric_limits<double>::quiet_NaN());
    ASSERT_EQ(instance->step(static_cast<double>(k) * 1e-3, 1e-3), FmuStatus::ok);
    EXPECT_EQ(instance->value("flow"), before);
    EXPECT_EQ(instance->status_bits(), static_cast<int>(sensor::Status::sample_missing));
  }
  const std::vector<double> after = run(*instance, 3050, 5000);
  EXPECT_EQ(instance->status_bits() & static_cast<int>(sensor::Status::sample_missing), 0);
  EXPECT_NEAR(after.back(), rows().estimates[8049].flow_m3_per_s, 0.02 * full_scale_m3_per_s);
}

TEST_P(SensorFmu, RefusesStepsThatDoNotAdvanceAndGoesOnAsIfTheyHadNotBeen) {
  const auto instance = begun();
  (void)run(*instance, 0, 100);
  EXPECT_EQ(instance->step(0.1, 0.0), FmuStatus::discard);
  EXPECT_EQ(instance->step(0.1, -1e-3), FmuStatus::discard);
  EXPECT_EQ(instance->step(0.05, 1e-3), FmuStatus::discard);
  EXPECT_EQ(instance->step(0.1, std::numeric_limits<double>::quiet_NaN()), FmuStatus::discard);
  EXPECT_THAT(log.messages, AllOf(Contains(HasSubstr("time must advance")), Contains(HasSubstr("last one ended"))));
  const auto undisturbed = begun();
  (void)run(*undisturbed, 0, 100);
  EXPECT_EQ(run(*instance, 100, 400), run(*undisturbed, 100, 400));
}

TEST_P(SensorFmu, CountsItsSamplesSoThatTimeDoesNotDrift) {
  // Twenty thousand steps of a tenth of a millisecond, added up as importers do, are 2 s and 2000 samples.
  const auto summed = begun();
  const auto whole = begun();
  put_row(*summed, 0);
  put_row(*whole, 0);
  double time_s = 0;
  for (int k = 0; k < 20000; ++k) {
    ASSERT_EQ(summed->step(time_s, 1e-4), FmuStatus::ok);
    time_s += 1e-4;
  }
  ASSERT_EQ(whole->step(0, 2.0), FmuStatus::ok);
  put_row(*summed, 1);
  put_row(*whole, 1);
  ASSERT_EQ(summed->step(time_s, 1e-3), FmuStatus::ok);
  ASSERT_EQ(whole->step(2.0, 1e-3), FmuStatus::ok);
  EXPECT_EQ(summed->value("flow"), whole->value("flow"));
  EXPECT_EQ(summed->value("flow_upper"), whole->value("flow_upper"));
}

TEST_P(SensorFmu, TakesTunedParametersAtTheNextSampleAndRefusesThoseOutOfRange) {
  const auto tuned = begun();
  const auto untouched = begun();
  EXPECT_EQ(run(*tuned, 0, 4000), run(*untouched, 0, 4000));  // the spool has opened by then
  tuned->put("filter.band_coverage", 2.5);
  (void)run(*tuned, 4000, 10);
  (void)run(*untouched, 4000, 10);
  EXPECT_GT(tuned->value("flow_upper") - tuned->value("flow_lower"),
            untouched->value("flow_upper") - untouched->value("flow_lower"));
  EXPECT_EQ(tuned->set(fmu.reference("filter.band_coverage"), -1), FmuStatus::error);
  EXPECT_EQ(tuned->set(fmu.reference("sample_step"), 2e-3), FmuStatus::error);  // fixed
  EXPECT_EQ(tuned->set(fmu.reference("flow"), 0), FmuStatus::error);
  EXPECT_EQ(tuned->set(9999, 0), FmuStatus::error);
  EXPECT_EQ(tuned->value("filter.band_coverage"), 2.5);
}

TEST_P(SensorFmu, WithoutVoltageAnswersAsEstimateWithoutThatChannel) {
  const auto instance = library.instantiate(log);
  ASSERT_EQ(instance->set_flag(fmu.reference("use_voltage"), false), FmuStatus::ok);
  begin(*instance);
  const std::vector<double> flow = run(*instance, 0, 3000);
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  estimation::RunningSensor sensor(&model.observer->parameters, full_scale_m3_per_s);
  for (std::size_t k = 0; k < flow.size(); ++k) {
    const auto expected =
        sensor.step({1e-3 * static_cast<double>(k), rows().current_A[k], std::numeric_limits<double>::quiet_NaN(),
                     rows().position_m[k], rows().temperature_K[k]});
    ASSERT_NEAR(flow[k], expected.flow_m3_per_s, 1e-6 * full_scale_m3_per_s) << k;
  }
}

TEST_P(SensorFmu, RefusesAnotherTokenAndADamagedOrMissingResource) {
  EXPECT_EQ(library.instantiate(log, "{00000000-0000-0000-0000-000000000000}"), nullptr);
  EXPECT_THAT(log.messages, Contains(HasSubstr("token")));
  const std::string name = "resources/parameters.bin";
  const std::string good = fmu.content(name);
  for (const std::size_t at : {std::size_t{3}, std::size_t{20}, good.size() / 2, good.size() - 1}) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    fmu.write(name, bad);
    log.messages.clear();
    EXPECT_EQ(library.instantiate(log), nullptr) << at;
    EXPECT_THAT(log.messages, Contains(AllOf(HasSubstr(name), HasSubstr("export the FMU again"))));
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{30}, good.size() - 9}) {
    fmu.write(name, good.substr(0, size));
    EXPECT_EQ(library.instantiate(log), nullptr) << size;
  }
  std::filesystem::remove(fmu.folder() / name);
  log.messages.clear();
  EXPECT_EQ(library.instantiate(log), nullptr);
  EXPECT_THAT(log.messages, Contains(HasSubstr("cannot be opened")));
}

TEST_P(SensorFmu, OfAModelWithoutObserverRunsTheCondensedSensorAndSaysSo) {
  model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  model.observer.reset();
  const UnpackedFmu condensed(sensor_fmu(model, GetParam(), "0.1.0"));
  EXPECT_THAT(condensed.description().front()["description"], HasSubstr("(condensed)"));
  const FmuLibrary other(condensed);
  const auto instance = other.instantiate(log);
  ASSERT_NE(instance, nullptr);
  begin(*instance);
  estimation::RunningSensor sensor(&model.condensed.parameters, full_scale_m3_per_s);
  const std::vector<double> flow = run(*instance, 0, 100);
  for (std::size_t k = 0; k < flow.size(); ++k) {
    const auto expected = sensor.step({1e-3 * static_cast<double>(k), rows().current_A[k], rows().voltage_V[k],
                                       rows().position_m[k], rows().temperature_K[k]});
    EXPECT_EQ(flow[k], expected.flow_m3_per_s);
  }
}

TEST_P(SensorFmu, RefusesCallsInTheWrongOrder) {
  const auto instance = library.instantiate(log);
  EXPECT_EQ(instance->step(0, 1e-3), FmuStatus::error);
  EXPECT_EQ(instance->exit_initialization(), FmuStatus::error);
  EXPECT_EQ(instance->terminate(), FmuStatus::error);
  begin(*instance);
  EXPECT_EQ(instance->exit_initialization(), FmuStatus::error);
  EXPECT_EQ(instance->terminate(), FmuStatus::ok);
  EXPECT_EQ(instance->step(0, 1e-3), FmuStatus::error);
  EXPECT_THAT(log.messages, Contains(HasSubstr("not allowed here")));
}

INSTANTIATE_TEST_SUITE_P(By, SensorFmu, ::testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& version) { return version.param == FmiVersion::fmi2 ? "Fmi2" : "Fmi3"; });

}  // namespace
}  // namespace spoolflow::exports
