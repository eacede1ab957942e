#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/export/c_interface/spoolflow.h"
#include "spoolflow/export/state_bytes.hpp"

namespace {

namespace exports = spoolflow::exports;
using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const example_model = SPOOLFLOW_EXAMPLE_MODEL;

struct Destroy {
  void operator()(spoolflow_sensor* sensor) const { spoolflow_destroy(sensor); }
};
using Sensor = std::unique_ptr<spoolflow_sensor, Destroy>;

Sensor sensor_of(spoolflow_estimator estimator = SPOOLFLOW_BEST) {
  spoolflow_sensor* sensor = nullptr;
  char message[256];
  EXPECT_EQ(spoolflow_create(example_model, estimator, &sensor, message, sizeof message), SPOOLFLOW_OK) << message;
  return Sensor(sensor);
}

std::string example_text() {
  std::ifstream in(example_model, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A spool that opens and closes under a current that follows it; made up.
spoolflow_sample sample_at(int k) {
  const double phase = 0.002 * k;
  return {1e-3 * k, 1.0 + 0.6 * std::sin(phase), 3.0 + 1.8 * std::sin(phase), 1.1e-3 + 0.8e-3 * std::sin(phase), 318.0};
}

spoolflow_estimate step(const Sensor& sensor, const spoolflow_sample& sample) {
  spoolflow_estimate estimate;
  EXPECT_EQ(spoolflow_step(sensor.get(), &sample, &estimate), SPOOLFLOW_OK);
  return estimate;
}

std::vector<double> flows(const Sensor& sensor, int from, int to) {
  std::vector<double> out;
  for (int k = from; k < to; ++k) out.push_back(step(sensor, sample_at(k)).flow_m3_per_s);
  return out;
}

TEST(CInterface, SurvivesTextThatNestsWithoutEnd) {
  for (const std::string& nest : {std::string(80000, '['), std::string(80000, '{')}) {
    const std::string text = "{\"format\": \"spoolflow model\", \"version\": " + nest;
    spoolflow_sensor* sensor = nullptr;
    char message[256];
    EXPECT_EQ(spoolflow_create_from_memory(text.data(), text.size(), SPOOLFLOW_BEST, &sensor, message, sizeof message),
              SPOOLFLOW_BAD_MODEL);
    EXPECT_EQ(sensor, nullptr);
    EXPECT_THAT(message, HasSubstr("nests deeper than 64 levels"));
  }
}

TEST(CInterface, RunsTheObserverWhereTheModelHasOneAndSaysWhichSensorRuns) {
  EXPECT_EQ(spoolflow_runs(sensor_of().get()), SPOOLFLOW_OBSERVER);
  const Sensor condensed = sensor_of(SPOOLFLOW_CONDENSED);
  EXPECT_EQ(spoolflow_runs(condensed.get()), SPOOLFLOW_CONDENSED);
  EXPECT_NEAR(spoolflow_rated_flow(condensed.get()), 80.0 / 60000, 1e-9);
  EXPECT_STRNE(spoolflow_valve_name(condensed.get()), "");
  EXPECT_THAT(spoolflow_version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(CInterface, RefusesTheObserverOfAModelThatIsNotCalibratedForItAndFallsBackWhereItMay) {
  std::string text = example_text();
  const auto at = text.find("\"observer\"");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 10, "\"unknown_\"");
  spoolflow_sensor* sensor = nullptr;
  char message[256];
  EXPECT_EQ(
      spoolflow_create_from_memory(text.data(), text.size(), SPOOLFLOW_OBSERVER, &sensor, message, sizeof message),
      SPOOLFLOW_NOT_CALIBRATED);
  EXPECT_EQ(sensor, nullptr);
  EXPECT_THAT(message, AllOf(HasSubstr("not calibrated for the observer"), HasSubstr("condensed")));
  ASSERT_EQ(spoolflow_create_from_memory(text.data(), text.size(), SPOOLFLOW_BEST, &sensor, message, sizeof message),
            SPOOLFLOW_OK);
  EXPECT_STREQ(message, "");
  EXPECT_EQ(spoolflow_runs(sensor), SPOOLFLOW_CONDENSED);
  spoolflow_destroy(sensor);
}

TEST(CInterface, SeparatesAFileThatIsNotThereFromAModelThatIsDamaged) {
  spoolflow_sensor* sensor = nullptr;
  char message[256];
  EXPECT_EQ(spoolflow_create("/nowhere/valve.json", SPOOLFLOW_BEST, &sensor, message, sizeof message),
            SPOOLFLOW_BAD_FILE);
  EXPECT_THAT(message, HasSubstr("/nowhere/valve.json"));
  const std::string text = example_text().substr(0, 1000);
  EXPECT_EQ(spoolflow_create_from_memory(text.data(), text.size(), SPOOLFLOW_BEST, &sensor, message, sizeof message),
            SPOOLFLOW_BAD_MODEL);
  EXPECT_THAT(message, AllOf(HasSubstr("model, line "), HasSubstr("cut short")));
  char little[8];
  EXPECT_EQ(spoolflow_create_from_memory("{}", 2, SPOOLFLOW_BEST, &sensor, little, sizeof little), SPOOLFLOW_BAD_MODEL);
  EXPECT_EQ(std::string(little).size(), 7u);  // cut, and ended by 0
  EXPECT_EQ(spoolflow_create_from_memory("{}", 2, SPOOLFLOW_BEST, &sensor, nullptr, 0), SPOOLFLOW_BAD_MODEL);
}

TEST(CInterface, RefusesNullPointersInsteadOfCrashing) {
  spoolflow_sensor* sensor = nullptr;
  char message[64];
  EXPECT_EQ(spoolflow_create(nullptr, SPOOLFLOW_BEST, &sensor, message, sizeof message), SPOOLFLOW_BAD_ARGUMENT);
  EXPECT_THAT(message, HasSubstr("path"));
  EXPECT_EQ(spoolflow_create(example_model, SPOOLFLOW_BEST, nullptr, nullptr, 0), SPOOLFLOW_BAD_ARGUMENT);
  EXPECT_EQ(spoolflow_create(example_model, static_cast<spoolflow_estimator>(3), &sensor, nullptr, 0),
            SPOOLFLOW_BAD_ARGUMENT);
  EXPECT_EQ(spoolflow_step(nullptr, nullptr, nullptr), SPOOLFLOW_BAD_ARGUMENT);
  EXPECT_EQ(spoolflow_copy(nullptr, &sensor), SPOOLFLOW_BAD_ARGUMENT);
  EXPECT_EQ(spoolflow_reset(nullptr), SPOOLFLOW_BAD_ARGUMENT);
  EXPECT_EQ(spoolflow_state_size(nullptr), 0u);
  spoolflow_destroy(nullptr);
}

TEST(CInterface, StepsColumnsExactlyAsSamples) {
  const Sensor one = sensor_of(), all = sensor_of();
  constexpr int count = 3000;
  std::vector<double> time_s, current_A, voltage_V, position_m, temperature_K, flow(count);
  std::vector<std::uint32_t> status(count);
  for (int k = 0; k < count; ++k) {
    const spoolflow_sample sample = sample_at(k);
    time_s.push_back(sample.time_s);
    current_A.push_back(sample.current_A);
    voltage_V.push_back(sample.voltage_V);
    position_m.push_back(sample.position_m);
    temperature_K.push_back(sample.oil_temperature_K);
  }
  const spoolflow_inputs inputs{time_s.data(), current_A.data(), voltage_V.data(), position_m.data(),
                                temperature_K.data()};
  spoolflow_outputs outputs{};
  outputs.flow_m3_per_s = flow.data();
  outputs.status = status.data();
  ASSERT_EQ(spoolflow_step_arrays(all.get(), count, &inputs, &outputs), SPOOLFLOW_OK);
  EXPECT_EQ(flow, flows(one, 0, count));
  const spoolflow_inputs without_time{};
  EXPECT_EQ(spoolflow_step_arrays(all.get(), count, &without_time, &outputs), SPOOLFLOW_BAD_ARGUMENT);
}

TEST(CInterface, SaysThatInputsAreMissingAndRecoversWhenTheyAreBack) {
  const Sensor sensor = sensor_of();
  (void)flows(sensor, 0, 2000);
  const double before = step(sensor, sample_at(2000)).flow_m3_per_s;
  for (int k = 2001; k < 2100; ++k) {
    spoolflow_sample sample = sample_at(k);
    (k % 2 == 0 ? sample.current_A : sample.position_m) = k % 3 == 0 ? INFINITY : NAN;
    const spoolflow_estimate held = step(sensor, sample);
    EXPECT_EQ(held.status, SPOOLFLOW_STATUS_SAMPLE_MISSING);
    EXPECT_EQ(held.flow_m3_per_s, before);
  }
  const Sensor undisturbed = sensor_of();
  const std::vector<double> expected = flows(undisturbed, 0, 6000);
  const std::vector<double> recovered = flows(sensor, 2100, 6000);
  EXPECT_NEAR(recovered.back(), expected.back(), 0.005 * spoolflow_rated_flow(sensor.get()));
}

TEST(CInterface, StaysFiniteWhateverComesIn) {
  for (const spoolflow_estimator estimator : {SPOOLFLOW_CONDENSED, SPOOLFLOW_OBSERVER}) {
    const Sensor sensor = sensor_of(estimator);
    const double extreme[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e8, -1e8, 0.0, 1e-320};
    int turn = 0;
    for (int k = 0; k < 4000; ++k) {
      spoolflow_sample sample = sample_at(k);
      double* const member[] = {&sample.time_s, &sample.current_A, &sample.voltage_V, &sample.position_m,
                                &sample.oil_temperature_K};
      if (k % 7 == 0) *member[turn % 5] = extreme[turn % 9], ++turn;
      const spoolflow_estimate estimate = step(sensor, sample);
      ASSERT_TRUE(std::isfinite(estimate.flow_m3_per_s) && std::isfinite(estimate.flow_lower_m3_per_s) &&
                  std::isfinite(estimate.flow_upper_m3_per_s) && std::isfinite(estimate.pressure_difference_Pa))
          << k;
    }
  }
}

TEST(CInterface, ACopyAndARestoredStateGoOnAsTheOriginal) {
  const Sensor sensor = sensor_of();
  (void)flows(sensor, 0, 1500);
  std::vector<char> state(spoolflow_state_size(sensor.get()));
  EXPECT_EQ(spoolflow_get_state(sensor.get(), state.data(), state.size() - 1), SPOOLFLOW_TOO_SMALL);
  ASSERT_EQ(spoolflow_get_state(sensor.get(), state.data(), state.size()), SPOOLFLOW_OK);
  spoolflow_sensor* twin = nullptr;
  ASSERT_EQ(spoolflow_copy(sensor.get(), &twin), SPOOLFLOW_OK);
  const Sensor copy(twin);
  const std::vector<double> expected = flows(sensor, 1500, 2500);
  EXPECT_EQ(flows(copy, 1500, 2500), expected);
  const Sensor other = sensor_of();
  ASSERT_EQ(spoolflow_set_state(other.get(), state.data(), state.size(), nullptr, 0), SPOOLFLOW_OK);
  EXPECT_EQ(flows(other, 1500, 2500), expected);
  ASSERT_EQ(spoolflow_reset(other.get()), SPOOLFLOW_OK);
  EXPECT_EQ(flows(other, 0, 500), flows(sensor_of(), 0, 500));
}

TEST(CInterface, ASensorWhoseStateIsTakenAndGivenBackAllTheTimeAnswersAsIfItWereNot) {
  const Sensor whole = sensor_of(), handed = sensor_of();
  std::vector<char> state(spoolflow_state_size(handed.get()));
  for (int k = 0; k < 6000; k += 7) {
    const std::vector<double> expected = flows(whole, k, k + 7);
    ASSERT_EQ(flows(handed, k, k + 7), expected) << "sample " << k;
    ASSERT_EQ(spoolflow_get_state(handed.get(), state.data(), state.size()), SPOOLFLOW_OK);
    ASSERT_EQ(spoolflow_set_state(handed.get(), state.data(), state.size(), nullptr, 0), SPOOLFLOW_OK);
  }
}

TEST(CInterface, RefusesAStateThatIsDamagedOrOfAnotherEstimator) {
  const Sensor sensor = sensor_of();
  (void)flows(sensor, 0, 100);
  std::vector<char> state(spoolflow_state_size(sensor.get()));
  ASSERT_EQ(spoolflow_get_state(sensor.get(), state.data(), state.size()), SPOOLFLOW_OK);
  char message[128];
  const Sensor condensed = sensor_of(SPOOLFLOW_CONDENSED);
  EXPECT_EQ(spoolflow_set_state(condensed.get(), state.data(), state.size(), message, sizeof message),
            SPOOLFLOW_BAD_STATE);
  EXPECT_THAT(message, HasSubstr("another estimator"));
  EXPECT_EQ(spoolflow_set_state(sensor.get(), state.data(), 20, message, sizeof message), SPOOLFLOW_BAD_STATE);
  state[state.size() / 2] = static_cast<char>(state[state.size() / 2] ^ 1);
  EXPECT_EQ(spoolflow_set_state(sensor.get(), state.data(), state.size(), message, sizeof message),
            SPOOLFLOW_BAD_STATE);
  EXPECT_THAT(message, HasSubstr("damaged"));
}

TEST(CInterface, RefusesAStateWhoseHeldAnswerLiesOutsideOfItsBand) {
  const Sensor sensor = sensor_of();
  (void)flows(sensor, 0, 100);
  std::vector<char> state(spoolflow_state_size(sensor.get()));
  ASSERT_EQ(spoolflow_get_state(sensor.get(), state.data(), state.size()), SPOOLFLOW_OK);
  const spoolflow_sample missing{0.1, NAN, 5, 1e-3, 313};
  spoolflow_estimate held{};
  ASSERT_EQ(spoolflow_step(sensor.get(), &missing, &held), SPOOLFLOW_OK);
  // The flow that is held, wherever it lies, becomes 10 m3/s under a checksum that holds.
  constexpr std::size_t header = sizeof(exports::StateHeader);
  const double forged = 10;
  int found = 0;
  for (std::size_t at = header; at + sizeof(double) <= state.size(); at += sizeof(double)) {
    if (std::memcmp(state.data() + at, &held.flow_m3_per_s, sizeof(double)) != 0) continue;
    std::memcpy(state.data() + at, &forged, sizeof forged);
    ++found;
  }
  ASSERT_GT(found, 0);
  const std::uint64_t sum = spoolflow::numerics::checksum(state.data() + header, state.size() - header);
  std::memcpy(state.data() + offsetof(exports::StateHeader, checksum), &sum, sizeof sum);
  EXPECT_EQ(spoolflow_set_state(sensor.get(), state.data(), state.size(), nullptr, 0), SPOOLFLOW_BAD_STATE);
}

/// Gives bytes that hold `number` at one place a checksum that holds.
std::vector<char> forged_state(std::vector<char> state, std::size_t at, double number) {
  constexpr std::size_t header = sizeof(exports::StateHeader);
  std::memcpy(state.data() + at, &number, sizeof number);
  const std::uint64_t sum = spoolflow::numerics::checksum(state.data() + header, state.size() - header);
  std::memcpy(state.data() + offsetof(exports::StateHeader, checksum), &sum, sizeof sum);
  return state;
}

TEST(CInterface, NoAlteredNumberOfAStateThatIsTakenLeadsToAnAnswerThatIsNoNumber) {
  for (const spoolflow_estimator estimator : {SPOOLFLOW_CONDENSED, SPOOLFLOW_OBSERVER}) {
    const Sensor sensor = sensor_of(estimator);
    (void)flows(sensor, 0, 2000);
    std::vector<char> state(spoolflow_state_size(sensor.get()));
    ASSERT_EQ(spoolflow_get_state(sensor.get(), state.data(), state.size()), SPOOLFLOW_OK);
    int refused = 0;
    for (std::size_t at = sizeof(exports::StateHeader); at + sizeof(double) <= state.size(); at += sizeof(double)) {
      for (const double number :
           {double{NAN}, -double{INFINITY}, 1e300, -1e29, -1e6, -1.0, 0.0, 1e-300, 3.0, 1e9, 1e29}) {
        const std::vector<char> forged = forged_state(state, at, number);
        if (spoolflow_set_state(sensor.get(), forged.data(), forged.size(), nullptr, 0) != SPOOLFLOW_OK) {
          ++refused;
          continue;
        }
        for (int k = 2000; k < 2030; ++k) {
          const spoolflow_estimate answer = step(sensor, sample_at(k));
          ASSERT_TRUE(answer.flow_lower_m3_per_s <= answer.flow_m3_per_s &&
                      answer.flow_m3_per_s <= answer.flow_upper_m3_per_s && std::isfinite(answer.flow_m3_per_s) &&
                      std::isfinite(answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s) &&
                      std::isfinite(answer.pressure_difference_Pa))
              << "byte " << at << " made " << number << ", sample " << k;
        }
      }
    }
    EXPECT_GT(refused, 0);
  }
}

TEST(CInterface, SensorsInManyThreadsDoNotDisturbEachOther) {
  const std::vector<double> expected = flows(sensor_of(), 0, 1000);
  std::vector<std::vector<double>> got(4);
  std::vector<std::thread> threads;
  for (auto& result : got) {
    threads.emplace_back([&result] { result = flows(sensor_of(), 0, 1000); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : got) EXPECT_EQ(result, expected);
}

TEST(CInterface, NamesEveryStatusBit) {
  EXPECT_STREQ(spoolflow_status_name(SPOOLFLOW_STATUS_SPOOL_AT_REST), "spool_at_rest");
  EXPECT_EQ(spoolflow_status_name(0), nullptr);
  EXPECT_EQ(spoolflow_status_name(UINT32_C(1) << 31), nullptr);
  char text[64];
  EXPECT_EQ(spoolflow_status_text(SPOOLFLOW_STATUS_CLOSED | SPOOLFLOW_STATUS_TIME_FAULT, text, sizeof text), 17u);
  EXPECT_STREQ(text, "closed|time_fault");
  EXPECT_EQ(spoolflow_status_text(SPOOLFLOW_STATUS_TIME_FAULT, text, 5), 10u);
  EXPECT_STREQ(text, "time");
  EXPECT_EQ(spoolflow_status_text(0, text, sizeof text), 0u);
  EXPECT_STREQ(text, "");
  EXPECT_EQ(spoolflow_status_text(SPOOLFLOW_STATUS_CLOSED, nullptr, 0), 6u);
}

}  // namespace
