/// Whole valves in packs against single ones: each on its own side of the centre, with models of its own.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/estimation/batch/valve_batch.hpp"
#include "tests/estimation/batch/condensed_valve.hpp"
#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::estimation::batch {
namespace {

constexpr std::size_t whole_valves = 16;

/// What all valves measure, a number a sample and valve.
struct WholeRows {
  std::vector<float> time_step_s, current_a_A, current_b_A, voltage_a_V, voltage_b_V, position_m, oil_temperature_K;

  [[nodiscard]] WholeSampleRows all() const {
    return {time_step_s, current_a_A, current_b_A, voltage_a_V, voltage_b_V, position_m, oil_temperature_K};
  }
  [[nodiscard]] sensor::WholeValveSample<float> at(std::size_t k) const {
    return {time_step_s[k], current_a_A[k], current_b_A[k],      voltage_a_V[k],
            voltage_b_V[k], position_m[k],  oil_temperature_K[k]};
  }
};

/// To one end, a hold, through the centre to the other, a hold there and a rest in the centre: valve after valve later,
/// at three sampling rates. Where the spool turns over, both coils carry current. Some inputs are missing now and then,
/// and the time of one valve runs backwards.
WholeRows whole_rows(std::size_t samples) {
  std::mt19937 generator(7);
  std::normal_distribution<float> noise(0, 1);
  std::uniform_real_distribution<float> chance(0, 1);
  const auto unless = [&](float rare, float value) {
    return chance(generator) < rare ? std::numeric_limits<float>::quiet_NaN() : value;
  };
  WholeRows out;
  for (std::size_t k = 0; k < samples; ++k) {
    for (std::size_t v = 0; v < whole_valves; ++v) {
      const float step_s = 0.5e-3F * static_cast<float>(1 + v % 3);
      const float phase = std::fmod(static_cast<float>(k) * step_s + 0.17F * static_cast<float>(v), 1.6F);
      const float swing = std::sin(6.2831853F * std::min(phase, 1.0F));
      const float stroke = std::clamp(1.3F * swing, -1.0F, 1.0F);
      const float position_m = 2.2e-3F * stroke + 1e-6F * noise(generator);
      const auto coil_A = [&](float way) {
        const float wanted_A = way * stroke > 0 ? 0.35F + 0.9F * way * stroke : 0.3F * (1 + 5 * way * stroke);
        return phase > 1.0F ? 0 : std::max(wanted_A, 0.0F) + 2e-3F * noise(generator);
      };
      const float a_A = coil_A(-1), b_A = coil_A(1);
      out.time_step_s.push_back(v == 6 && k % 500 == 400 ? -step_s : step_s);
      out.current_a_A.push_back(unless(v % 5 == 1 ? 0.01F : 0, a_A));
      out.current_b_A.push_back(unless(v % 5 == 3 ? 0.01F : 0, b_A));
      out.voltage_a_V.push_back(unless(0.01F, 10 * a_A + 0.1F * noise(generator)));
      out.voltage_b_V.push_back(unless(0.01F, 10 * b_A + 0.1F * noise(generator)));
      out.position_m.push_back(unless(v % 5 == 2 ? 0.01F : 0, position_m));
      out.oil_temperature_K.push_back(unless(0.05F, 310 + 0.01F * static_cast<float>(k)));
    }
  }
  return out;
}

/// Of direction b and a of each valve, all unlike each other.
template <class Whole, class Model>
std::vector<Whole> whole_of(const std::vector<Model>& models) {
  std::vector<Whole> out;
  for (std::size_t v = 0; v < whole_valves; ++v) out.push_back({&models[v], &models[whole_valves + v]});
  return out;
}

/// The pack's answers against those of valves by themselves.
template <class Whole, class State>
void expect_alike(const std::vector<Whole>& valves, const WholeRows& rows, InstructionSet instructions,
                  std::uint32_t& seen) {
  std::vector<const Whole*> in_batch;
  for (const Whole& valve : valves) in_batch.push_back(&valve);
  const std::size_t numbers = rows.position_m.size();
  std::vector<float> flow(numbers), lower(numbers), upper(numbers), magnetic(numbers), friction(numbers);
  std::vector<sensor::Status> status(numbers);
  EstimateRows estimates{};
  estimates.flow_m3_per_s = flow;
  estimates.flow_lower_m3_per_s = lower;
  estimates.flow_upper_m3_per_s = upper;
  estimates.magnetic_force_N = magnetic;
  estimates.friction_force_N = friction;
  estimates.status = status;
  ValveBatch<Whole>(in_batch, instructions).step(rows.all(), estimates);

  std::vector<State> states(valves.size());
  std::size_t apart = 0, to_a = 0, to_b = 0, both_at_once = 0;
  bool row_to_a = false, row_to_b = false;
  for (std::size_t k = 0; k < numbers; ++k) {
    const std::size_t v = k % valves.size();
    const sensor::Estimate<float> alone = step(valves[v], states[v], rows.at(k));
    seen |= static_cast<std::uint32_t>(alone.status);
    if (v == 0) row_to_a = row_to_b = false;
    row_to_a = row_to_a || alone.flow_m3_per_s < -1e-5F;
    row_to_b = row_to_b || alone.flow_m3_per_s > 1e-5F;
    to_a += alone.flow_m3_per_s < -1e-5F ? 1 : 0;
    to_b += alone.flow_m3_per_s > 1e-5F ? 1 : 0;
    both_at_once += v + 1 == valves.size() && row_to_a && row_to_b ? 1 : 0;
    const auto near = [](float a, float b, float size) { return std::abs(a - b) <= 1e-5F * size; };  // false for NaN
    const bool alike = near(flow[k], alone.flow_m3_per_s, 1e-3F) && near(lower[k], alone.flow_lower_m3_per_s, 1e-3F) &&
                       near(upper[k], alone.flow_upper_m3_per_s, 1e-3F) &&
                       near(magnetic[k], alone.magnetic_force_N, 100) &&
                       near(friction[k], alone.friction_force_N, 10) && status[k] == alone.status;
    if (!alike && ++apart == 1)
      ADD_FAILURE() << "sample " << k / valves.size() << " of valve " << v << ": flow " << flow[k] << ", alone "
                    << alone.flow_m3_per_s << ", status " << static_cast<std::uint32_t>(status[k]) << ", alone "
                    << static_cast<std::uint32_t>(alone.status);
  }
  EXPECT_EQ(apart, 0U);
  EXPECT_GT(to_a, numbers / 5);
  EXPECT_GT(to_b, numbers / 5);
  EXPECT_GT(both_at_once, numbers / valves.size() / 2);  // in most samples some valves open P to A and some P to B
}

class WholeValveBatch : public testing::TestWithParam<InstructionSet> {};
INSTANTIATE_TEST_SUITE_P(Batch, WholeValveBatch, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name(set.param)); });

TEST_P(WholeValveBatch, AnswersSignedFlowOfValvesOnDifferentSidesAsEachWouldAlone) {
  using Whole = sensor::WholeValveParameters<float>;
  std::vector<sensor::ObserverParameters<float>> models;
  for (std::size_t k = 0; k < 2 * whole_valves; ++k) {
    const double scale = 0.8 + 0.02 * static_cast<double>((7 * k) % (2 * whole_valves));
    models.push_back(sensor::closed_form_observer<float>({.scale = scale}));
    if (k % 4 == 0) models.back().closed_below_m = 0;  // no overlap: the sign is not sure in the centre
  }
  const auto valves = whole_of<Whole>(models);
  std::uint32_t seen = 0;
  expect_alike<Whole, sensor::WholeValveState<float>>(valves, whole_rows(4000), GetParam(), seen);
  using sensor::Status;
  for (const Status bit :
       {Status::closed, Status::spool_at_rest, Status::sign_undetermined, Status::sample_missing, Status::time_fault}) {
    EXPECT_TRUE(has(static_cast<Status>(seen), bit)) << static_cast<std::uint32_t>(bit);
  }
}

TEST_P(WholeValveBatch, AnswersForCondensedSensorsAsEachWouldAlone) {
  using Whole = sensor::WholeCondensedTables<float>;
  std::vector<sensor::CondensedTables<float>> models(2 * whole_valves);
  for (std::size_t k = 0; k < models.size(); ++k)
    sensor::lay_out(condensed_valve(static_cast<int>(5 * k % 16)), models[k]);
  std::uint32_t seen = 0;
  expect_alike<Whole, sensor::WholeCondensedState<float>>(whole_of<Whole>(models), whole_rows(4000), GetParam(), seen);
  EXPECT_TRUE(has(static_cast<sensor::Status>(seen), sensor::Status::closed));
}

}  // namespace
}  // namespace spoolflow::estimation::batch
