#include "spoolflow/estimation/batch/valve_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/estimation/batch/condensed_valve.hpp"

namespace spoolflow::estimation::batch {
namespace {

using Tables = sensor::CondensedTables<float>;

std::vector<Tables> models(std::size_t count) {
  std::vector<Tables> out(count);
  for (std::size_t k = 0; k < count; ++k) sensor::lay_out(condensed_valve(static_cast<int>(k)), out[k]);
  return out;
}

/// A number a sample and valve.
struct ManyRows {
  std::vector<float> time_step_s, current_A, voltage_V, position_m, oil_temperature_K;

  [[nodiscard]] SampleRows all() const { return {time_step_s, current_A, voltage_V, position_m, oil_temperature_K}; }
  [[nodiscard]] sensor::Sample<float> at(std::size_t k) const {
    return {time_step_s[k], current_A[k], voltage_V[k], position_m[k], oil_temperature_K[k]};
  }
};

/// Currents and positions in and beyond the maps; some are missing, some time steps run backwards.
ManyRows wild_rows(std::size_t count) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> current_A(-0.5F, 4.5F), position_m(-0.3e-3F, 3.5e-3F), chance(0, 1);
  const float missing = std::numeric_limits<float>::quiet_NaN();
  ManyRows out;
  for (std::size_t k = 0; k < count; ++k) {
    out.time_step_s.push_back(chance(generator) < 0.02F ? -1e-3F : 1e-3F);
    out.current_A.push_back(chance(generator) < 0.05F ? missing : current_A(generator));
    out.voltage_V.push_back(missing);
    out.position_m.push_back(chance(generator) < 0.05F ? missing : position_m(generator));
    out.oil_temperature_K.push_back(320);
  }
  return out;
}

class EveryInstructionSet : public testing::TestWithParam<InstructionSet> {};
INSTANTIATE_TEST_SUITE_P(Batch, EveryInstructionSet, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name(set.param)); });

TEST_P(EveryInstructionSet, AnswersForManyValvesAsSingleSensorsDo) {
  constexpr std::size_t valves = 24, samples = 1000;
  const std::vector<Tables> tables = models(valves - 1);
  std::vector<const Tables*> in_batch(1, &tables[3]);  // one model stands twice
  for (const Tables& table : tables) in_batch.push_back(&table);
  const ManyRows rows = wild_rows(valves * samples);
  std::vector<float> flow(valves * samples), lower(flow), upper(flow), pressure(flow), force(flow);
  std::vector<sensor::Status> status(valves * samples);
  EstimateRows estimates{};
  estimates.flow_m3_per_s = flow;
  estimates.flow_lower_m3_per_s = lower;
  estimates.flow_upper_m3_per_s = upper;
  estimates.pressure_difference_Pa = pressure;
  estimates.flow_force_N = force;
  estimates.status = status;
  ValveBatch<Tables>(in_batch, GetParam()).step(rows.all(), estimates);

  std::vector<sensor::CondensedState<float>> states(valves);
  for (std::size_t k = 0; k < valves * samples; ++k) {
    const sensor::Estimate<float> alone = step(*in_batch[k % valves], states[k % valves], rows.at(k));
    const auto near = [&](float a, float b) { EXPECT_NEAR(a, b, 2e-6F * (std::abs(b) + 1e-4F)) << k; };
    near(flow[k], alone.flow_m3_per_s);
    near(lower[k], alone.flow_lower_m3_per_s);
    near(upper[k], alone.flow_upper_m3_per_s);
    near(pressure[k], alone.pressure_difference_Pa);
    near(force[k], alone.flow_force_N);
    EXPECT_EQ(status[k], alone.status) << k;
  }
}

TEST_P(EveryInstructionSet, GoesOnWhereTheLastCallEnded) {
  constexpr std::size_t valves = 3 * valves_together;  // sixteen in one register, and eight that are left
  const std::vector<Tables> tables = models(1);
  const std::vector<const Tables*> in_batch(valves, tables.data());
  ManyRows held = wild_rows(valves);
  ManyRows good = held;
  std::fill(good.time_step_s.begin(), good.time_step_s.end(), 1e-3F);
  std::fill(good.current_A.begin(), good.current_A.end(), 1.5F);
  std::fill(good.position_m.begin(), good.position_m.end(), 1e-3F);
  std::fill(held.current_A.begin(), held.current_A.end(), std::numeric_limits<float>::quiet_NaN());
  std::vector<float> first(valves), second(valves);
  EstimateRows estimates{};
  estimates.flow_m3_per_s = first;
  ValveBatch<Tables> batch(in_batch, GetParam());
  batch.step(good.all(), estimates);
  estimates.flow_m3_per_s = second;
  batch.step(held.all(), estimates);
  EXPECT_GT(first.front(), 0);
  EXPECT_GT(first.back(), 0);
  EXPECT_EQ(first, second);
}

TEST(ValveBatch, RefusesWhatIsNoWholeNumberOfValvesOrSamples) {
  const std::vector<Tables> tables = models(1);
  const std::vector<const Tables*> seven(7, tables.data()), eight(8, tables.data());
  EXPECT_THROW(ValveBatch<Tables>{seven}, std::invalid_argument);
  ValveBatch<Tables> batch(eight);
  EXPECT_THROW(batch.step(wild_rows(12).all(), {}), std::invalid_argument);
  ManyRows rows = wild_rows(16);
  rows.position_m.resize(8);
  EXPECT_THROW(batch.step(rows.all(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace spoolflow::estimation::batch
