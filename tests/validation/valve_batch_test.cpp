#include "spoolflow/validation/valve_batch.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

/// A valve with forces and flows of its own; `k` makes it another one.
sensor::CondensedParameters<float> valve(int k) {
  sensor::CondensedParameters<float> out{};
  const float wide = 1.0F + 0.05F * static_cast<float>(k);
  const auto axis = [&](float last, int points) {
    const float spacing = wide * last / static_cast<float>(points - 1);
    return sensor::Axis<float>{0, spacing, 1 / spacing};
  };
  auto& magnetic = out.magnetic_force;
  magnetic.map.row_axis = magnetic.hysteresis_half_width_N.axis = axis(3, sensor::force_map_currents);
  magnetic.map.column_axis = axis(2.4e-3F, sensor::force_map_positions);
  for (int r = 0; r < sensor::force_map_currents; ++r) {
    magnetic.hysteresis_half_width_N.values[static_cast<unsigned>(r)] = 0.1F * wide * static_cast<float>(r);
    for (int c = 0; c < sensor::force_map_positions; ++c)
      magnetic.map.node(r, c) = 2.5F * static_cast<float>(r) * (1 + 0.01F * static_cast<float>(c));
  }
  out.spring.curve.axis = out.friction_half_width_N.axis = axis(2.4e-3F, sensor::spring_positions);
  for (unsigned s = 0; s < sensor::spring_positions; ++s) {
    out.spring.curve.values[s] = 9 + 0.8F * static_cast<float>(s);
    out.friction_half_width_N.values[s] = 1 + 0.05F * static_cast<float>(s);
  }
  auto& flow = out.flow_rate;
  flow.largest_force_N.axis = flow.flow_m3_per_s.row_axis = flow.root_pressure_difference.row_axis =
      axis(2.4e-3F, sensor::flow_map_positions);
  flow.flow_m3_per_s.column_axis = flow.root_pressure_difference.column_axis = sensor::Axis<float>{0, 1.0F / 16, 16};
  for (int p = 0; p < sensor::flow_map_positions; ++p) {
    flow.largest_force_N.values[static_cast<unsigned>(p)] = 2 + 0.6F * static_cast<float>(p);
    for (int f = 0; f < sensor::flow_map_forces; ++f) {
      flow.flow_m3_per_s.node(p, f) = 1.7e-6F * wide * static_cast<float>(p * f);
      flow.root_pressure_difference.node(p, f) = 165.0F * static_cast<float>(f);
    }
  }
  out.closed_below_m = 0.1e-3F;
  out.force_residual_N = 0.5F;
  out.flow_residual_m3_per_s = 1e-6F;
  return out;
}

template <int N>
void expect_as_single_valves() {
  std::vector<sensor::CondensedTables<float>> valves(N);
  std::array<sensor::CondensedState<float>, N> states;
  std::array<const sensor::CondensedTables<float>*, N> in_batch;
  for (std::size_t k = 0; k < N; ++k) {
    sensor::lay_out(valve(static_cast<int>(k)), valves[k]);
    in_batch[k] = &valves[k];
  }
  ValveBatch<N> batch(in_batch);
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> current_A(-0.5F, 4.5F), position_m(-0.3e-3F, 3.5e-3F), chance(0, 1);
  const float missing = std::numeric_limits<float>::quiet_NaN();
  for (int n = 0; n < 3000; ++n) {
    std::array<sensor::Sample<float>, N> samples;
    std::array<float, N> time_step_s, current_A_all, position_m_all;
    for (std::size_t k = 0; k < N; ++k) {
      samples[k] = {chance(generator) < 0.02F ? -1e-3F : 1e-3F,
                    chance(generator) < 0.05F ? missing : current_A(generator), missing,
                    chance(generator) < 0.05F ? missing : position_m(generator), 320};
      time_step_s[k] = samples[k].time_step_s;
      current_A_all[k] = samples[k].current_A;
      position_m_all[k] = samples[k].position_m;
    }
    using Pack = ValvePack<N>;
    const auto& together = batch.step({Pack(time_step_s), Pack(current_A_all), Pack(), Pack(position_m_all), Pack()});
    for (std::size_t k = 0; k < N; ++k) {
      const sensor::Estimate<float> alone = step(valves[k], states[k], samples[k]);
      const auto near = [&](float a, float b) { EXPECT_NEAR(a, b, 2e-6F * (std::abs(b) + 1e-4F)) << n << ' ' << k; };
      near(together.flow_m3_per_s.numbers()[k], alone.flow_m3_per_s);
      near(together.flow_lower_m3_per_s.numbers()[k], alone.flow_lower_m3_per_s);
      near(together.flow_upper_m3_per_s.numbers()[k], alone.flow_upper_m3_per_s);
      near(together.pressure_difference_Pa.numbers()[k], alone.pressure_difference_Pa);
      near(together.flow_force_N.numbers()[k], alone.flow_force_N);
      EXPECT_EQ(together.status.at(k), alone.status) << n << ' ' << k;
    }
  }
}

TEST(ValveBatch, AnswersForEightValvesAsEightSensorsDo) {
  expect_as_single_valves<8>();
}

TEST(ValveBatch, AnswersForSixteenValvesAsSixteenSensorsDo) {
  expect_as_single_valves<16>();
}

}  // namespace
}  // namespace spoolflow::validation
