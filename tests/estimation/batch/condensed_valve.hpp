#pragma once
#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::estimation::batch {

/// A valve with forces and flows of its own; `k` makes it another one.
inline sensor::CondensedParameters<float> condensed_valve(int k) {
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

}  // namespace spoolflow::estimation::batch
