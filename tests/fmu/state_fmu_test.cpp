/// What an instance promises of its values, steps and states, whatever its importer does.
#include <cstddef>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/export/sensor_fmu.hpp"
#include "spoolflow/export/state_bytes.hpp"
#include "spoolflow/model/model.hpp"
#include "tests/fmu/fmu_instance.hpp"

namespace spoolflow::exports {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class StateFmu : public ::testing::TestWithParam<FmiVersion> {
 protected:
  std::unique_ptr<FmuInstance> begun() {
    auto instance = library.instantiate(log);
    EXPECT_EQ(instance->enter_initialization(0), FmuStatus::ok);
    EXPECT_EQ(instance->exit_initialization(), FmuStatus::ok);
    return instance;
  }
  /// A spool that opens with its current, a step a millisecond.
  static void run(FmuInstance& instance, int steps) {
    for (int k = 0; k < steps; ++k) {
      instance.put("current", 1e-3 * k);
      instance.put("position", 2e-6 * k);
      EXPECT_EQ(instance.step(1e-3 * k, 1e-3), FmuStatus::ok);
    }
  }

  const UnpackedFmu fmu{sensor_fmu(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), GetParam(), "0.1.0")};
  const FmuLibrary library{fmu};
  FmuLog log;
};

TEST_P(StateFmu, SetsAllOfSeveralValuesOrNone) {
  const auto instance = begun();
  instance->put("current", 0.5);
  EXPECT_EQ(instance->set_all({fmu.reference("current"), fmu.reference("flow")}, {0.7, 1.0}), FmuStatus::error);
  EXPECT_EQ(instance->value("current"), 0.5);
  EXPECT_EQ(instance->set_all({fmu.reference("current"), fmu.reference("position")}, {0.7, 1e-3}), FmuStatus::ok);
  EXPECT_EQ(instance->value("current"), 0.7);
}

TEST_P(StateFmu, RefusesAStepOfMoreThanTenMillionSamplesAndGoesOn) {
  const auto instance = begun();
  EXPECT_EQ(instance->step(0, 1e9), FmuStatus::discard);
  EXPECT_THAT(log.messages, Contains(HasSubstr("cut it into shorter ones")));
  EXPECT_EQ(instance->step(0, 1e-3), FmuStatus::ok);
}

TEST_P(StateFmu, StatesThatAreEqualHaveEqualBytesAndForgedOnesAreRefused) {
  const auto one = begun(), other = begun();
  run(*one, 500);
  run(*other, 500);
  const std::vector<char> state = one->state();
  EXPECT_EQ(state, other->state());
  // Each byte of the state in turn becomes what no flag, count or kind of motion is, under a checksum that holds.
  constexpr std::size_t header = sizeof(StateHeader);
  int refused = 0;
  for (std::size_t k = header; k < state.size(); k += 7) {
    std::vector<char> forged = state;
    forged[k] = static_cast<char>(0xEE);
    const std::uint64_t sum = numerics::checksum(forged.data() + header, forged.size() - header);
    std::memcpy(forged.data() + offsetof(StateHeader, checksum), &sum, sizeof sum);
    if (other->set_state(forged) != FmuStatus::ok) {
      ++refused;
    } else {
      other->step(0.5, 1e-3);  // whatever it answers, it answers
      other->set_state(state);
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_P(StateFmu, AStateOfWhichOneNumberCannotBeLeavesTheInstanceAsItWas) {
  const auto instance = begun();
  run(*instance, 500);
  const std::vector<char> state = instance->state();
  constexpr std::size_t header = sizeof(StateHeader);
  int refused = 0;
  for (std::size_t k = header; k + sizeof(double) <= state.size(); k += sizeof(double)) {
    std::vector<char> forged = state;
    const double extreme = -1e300;
    std::memcpy(forged.data() + k, &extreme, sizeof extreme);
    const std::uint64_t sum = numerics::checksum(forged.data() + header, forged.size() - header);
    std::memcpy(forged.data() + offsetof(StateHeader, checksum), &sum, sizeof sum);
    if (instance->set_state(forged) == FmuStatus::ok) {
      EXPECT_EQ(instance->set_state(state), FmuStatus::ok);
    } else {
      ++refused;
      ASSERT_EQ(instance->state(), state) << k;
    }
  }
  EXPECT_GT(refused, 10);
}

INSTANTIATE_TEST_SUITE_P(Versions, StateFmu, ::testing::Values(FmiVersion::fmi2, FmiVersion::fmi3));

}  // namespace
}  // namespace spoolflow::exports
