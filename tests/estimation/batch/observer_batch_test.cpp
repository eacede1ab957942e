/// The observer of many valves at once against single observers, over runs that take it through all of its modes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/estimation/batch/valve_batch.hpp"

namespace spoolflow::estimation::batch {
namespace {

using Observer = sensor::ObserverParameters<float>;

sensor::Axis<float> axis(float first, float last, int points) {
  const float spacing = (last - first) / static_cast<float>(points - 1);
  return {first, spacing, 1 / spacing};
}

template <int Rows, int Columns, class At>
void fill(sensor::Map<float, Rows, Columns>& map, float last_row, float last_column, const At& at) {
  map.row_axis = axis(0, last_row, Rows);
  map.column_axis = axis(0, last_column, Columns);
  for (int r = 0; r < Rows; ++r)
    for (int c = 0; c < Columns; ++c) map.node(r, c) = at(map.row_axis.at(r), map.column_axis.at(c));
}

/// A valve in closed form; `k` makes it another one.
Observer valve(int k) {
  const float wide = 1.0F + 0.02F * static_cast<float>(k);
  Observer out{};
  auto& actuator = out.actuator;
  fill(actuator.magnetic_force.map, 2.5F, 2.4e-3F, [&](float i, float x) { return 30 * wide * i * (1 + 40 * x); });
  fill(actuator.friction_N, 2.5F, 2.4e-3F, [](float i, float /*x*/) { return 0.3F + 0.4F * i; });
  fill(actuator.coil.flux_linkage.map, 2.5F, 2.4e-3F,
       [](float i, float x) { return 0.1F * i / (1 + 0.2F * i) * (1 + 50 * x); });
  for (unsigned s = 0; s < sensor::hysteresis_elements; ++s) {
    actuator.coil.hysteresis.threshold[s] = 0.002F * static_cast<float>(s + 1);
    actuator.coil.hysteresis.stiffness[s] = 1.5F * wide;
    actuator.coil.hysteresis.stiffness_increase[s] = 0.5F;
  }
  actuator.coil.hysteresis.per_full_flux = 5;
  actuator.coil.eddy_currents = {2e-3F, 5e-3F, 0.1F};
  actuator.coil_resistance = {10, 1, 0.01F, 0.05F};
  actuator.coercive_current_A = 0.1F;
  actuator.per_wiping_flux = 20;
  actuator.force_uncertainty_N = 0.5F;
  actuator.current_uncertainty_A = 0.005F;
  actuator.eddy_uncertainty = 0.2F;
  out.spring.curve.axis = axis(0, 2.4e-3F, sensor::spring_positions);
  for (int s = 0; s < sensor::spring_positions; ++s)
    out.spring.curve.values[static_cast<unsigned>(s)] = 8 + 9e3F * out.spring.curve.axis.at(s);
  auto& edge = out.edge;
  edge.temperature_K = axis(303, 343, sensor::edge_temperatures);
  edge.pressure_difference_Pa = axis(0, 90e5F, sensor::edge_pressures);
  edge.position_m = axis(0, 2.4e-3F, sensor::edge_positions);
  for (int t = 0; t < sensor::edge_temperatures; ++t) {
    for (int p = 0; p < sensor::edge_pressures; ++p) {
      for (int x = 0; x < sensor::edge_positions; ++x) {
        const float open_m = std::max(edge.position_m.at(x) - 0.2e-3F, 0.0F);
        const float warm = 1 + 0.05F * static_cast<float>(t);
        edge.flow_force_N.node(t, p, x) = 2.5e-3F * open_m * edge.pressure_difference_Pa.at(p);
        edge.friction_N.node(t, p, x) = (2 + 2e-7F * edge.pressure_difference_Pa.at(p)) / warm;
        edge.conductance.node(t, p, x) = 2e-4F * wide * warm * open_m;
      }
    }
  }
  out.position_sensor = {1e-6F, 3e-6F, 1e-7F, 313, 200};
  out.friction = {1.6F, 0.5F, 2e5F, 0.5F, 0.3F, 0.9F};
  out.pressure = {4e6F, 2e6F, 0.05F, 0.3F, 0.5F, 0.05F, 0.3F, 20};
  out.band = {0.2F, 0.5F, 5e-6F, 2, 0.5F, 0.4F, 0.5F, 0.02F, 1.5F};
  out.moving_mass_kg = 0.1F;
  out.closed_below_m = 0.25e-3F;
  out.largest_current_A = 2.4F;
  return out;
}

/// A number a sample and valve.
struct Rows {
  std::vector<float> time_step_s, current_A, voltage_V, position_m, oil_temperature_K;

  [[nodiscard]] sensor::Sample<float> at(std::size_t k) const {
    return {time_step_s[k], current_A[k], voltage_V[k], position_m[k], oil_temperature_K[k]};
  }
};

/// Each valve moves, holds and creeps at times of its own, at its own sampling rate; now and then an input is missing,
/// the time runs backwards, or the position signal jumps.
Rows run(std::size_t valves, std::size_t samples) {
  std::mt19937 generator(5);
  std::normal_distribution<float> noise(0, 1);
  std::uniform_real_distribution<float> chance(0, 1);
  const auto unless = [&](float rare, float value) {
    return chance(generator) < rare ? std::numeric_limits<float>::quiet_NaN() : value;
  };
  Rows out;
  for (std::size_t k = 0; k < samples; ++k) {
    for (std::size_t v = 0; v < valves; ++v) {
      const float step_s = 0.5e-3F * static_cast<float>(1 + v % 3);
      const float phase = std::fmod(static_cast<float>(k) * step_s + 0.37F * static_cast<float>(v), 2.0F);
      const float stroke = phase < 0.6F ? phase / 0.6F : phase < 1.0F ? 1 : phase < 1.6F ? (1.6F - phase) / 0.6F : 0;
      const float position_m = 2.3e-3F * stroke + 1e-6F * noise(generator) + (k % 700 > 690 && v == 4 ? 4e-4F : 0.0F);
      const float current_A = 0.3F + 0.9F * stroke + (phase < 1.0F ? 0.1F : -0.05F) + 2e-3F * noise(generator);
      out.time_step_s.push_back(v == 6 && k % 500 == 400 ? -step_s : step_s);
      out.current_A.push_back(unless(v % 5 == 1 ? 0.01F : 0, current_A));
      out.voltage_V.push_back(unless(0.01F, 10 * current_A + 0.1F * noise(generator)));
      out.position_m.push_back(unless(v % 5 == 2 ? 0.01F : 0, position_m));
      out.oil_temperature_K.push_back(unless(0.05F, 290 + 0.02F * static_cast<float>(k)));
    }
  }
  return out;
}

class ObserverBatch : public testing::TestWithParam<InstructionSet> {};
INSTANTIATE_TEST_SUITE_P(Batch, ObserverBatch, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name(set.param)); });

TEST_P(ObserverBatch, AnswersForDifferentValvesInAllModesAsSingleObserversDo) {
  constexpr std::size_t valves = 16, samples = 3000;
  std::vector<Observer> models;
  for (std::size_t v = 0; v < valves; ++v) models.push_back(valve(static_cast<int>(v)));
  std::vector<const Observer*> in_batch;
  for (const Observer& model : models) in_batch.push_back(&model);
  const Rows rows = run(valves, samples);
  std::vector<float> flow(valves * samples), lower(flow), upper(flow), friction(flow);
  std::vector<sensor::Status> status(valves * samples);
  EstimateRows estimates{};
  estimates.flow_m3_per_s = flow;
  estimates.flow_lower_m3_per_s = lower;
  estimates.flow_upper_m3_per_s = upper;
  estimates.friction_force_N = friction;
  estimates.status = status;
  ValveBatch<Observer>(in_batch, GetParam())
      .step({rows.time_step_s, rows.current_A, rows.voltage_V, rows.position_m, rows.oil_temperature_K}, estimates);

  std::vector<sensor::ObserverState<float>> states(valves);
  std::uint32_t seen = 0;
  std::size_t sliding = 0, apart = 0;
  for (std::size_t k = 0; k < valves * samples; ++k) {
    const sensor::Estimate<float>& alone = step(models[k % valves], states[k % valves], rows.at(k));
    seen |= static_cast<std::uint32_t>(alone.status);
    sliding += has(alone.status, sensor::Status::spool_at_rest) ? 0 : 1;
    const auto near = [&](float a, float b, float size) { return std::abs(a - b) <= 1e-5F * size; };  // false for NaN
    const bool alike = near(flow[k], alone.flow_m3_per_s, 1e-3F) && near(lower[k], alone.flow_lower_m3_per_s, 1e-3F) &&
                       near(upper[k], alone.flow_upper_m3_per_s, 1e-3F) &&
                       near(friction[k], alone.friction_force_N, 10) && status[k] == alone.status;
    if (!alike && ++apart == 1) ADD_FAILURE() << "sample " << k / valves << " of valve " << k % valves;
  }
  EXPECT_EQ(apart, 0U);
  EXPECT_GT(sliding, samples);  // of all valves: no mode is left out
  using sensor::Status;
  for (const Status bit : {Status::closed, Status::spool_at_rest, Status::position_fault, Status::sample_missing,
                           Status::time_fault, Status::outside_temperature}) {
    EXPECT_TRUE(has(static_cast<Status>(seen), bit)) << static_cast<std::uint32_t>(bit);
  }
}

}  // namespace
}  // namespace spoolflow::estimation::batch
