#pragma once
#include <cmath>

#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::sensor {

/// A valve in closed form: 20 N/A of magnetic force, 10 N/mm of spring, flow force up to 50 N with Q = sqrt(F) L/min
/// scale.
inline CondensedParameters<double> linear_valve() {
  CondensedParameters<double> valve{};
  const auto axis = [](double last, int points) { return Axis<double>{0, last / (points - 1), (points - 1) / last}; };
  auto& magnetic = valve.magnetic_force;
  magnetic.map.row_axis = axis(3.2, force_map_currents);
  magnetic.map.column_axis = axis(2.5e-3, force_map_positions);
  magnetic.hysteresis_half_width_N.axis = magnetic.map.row_axis;
  for (int r = 0; r < force_map_currents; ++r) {
    for (int c = 0; c < force_map_positions; ++c) magnetic.map.node(r, c) = 20 * magnetic.map.row_axis.at(r);
  }
  valve.spring.curve.axis = valve.friction_half_width_N.axis = axis(2.4e-3, spring_positions);
  for (int k = 0; k < spring_positions; ++k) {
    valve.spring.curve.values[static_cast<unsigned>(k)] = 1e4 * valve.spring.curve.axis.at(k);
    valve.friction_half_width_N.values[static_cast<unsigned>(k)] = 2;
  }
  auto& flow = valve.flow_rate;
  flow.largest_force_N.axis = flow.flow_m3_per_s.row_axis = flow.root_pressure_difference.row_axis =
      axis(2.4e-3, flow_map_positions);
  flow.flow_m3_per_s.column_axis = flow.root_pressure_difference.column_axis = axis(1, flow_map_forces);
  for (int p = 0; p < flow_map_positions; ++p) {
    flow.largest_force_N.values[static_cast<unsigned>(p)] = 50;
    for (int f = 0; f < flow_map_forces; ++f) {
      flow.flow_m3_per_s.node(p, f) = 1e-3 * flow.flow_m3_per_s.column_axis.at(f);
      flow.root_pressure_difference.node(p, f) = std::sqrt(70e5) * flow.flow_m3_per_s.column_axis.at(f);
    }
  }
  valve.closed_below_m = 0.1e-3;
  return valve;
}

}  // namespace spoolflow::sensor
