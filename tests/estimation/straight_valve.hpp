#pragma once
/// A condensed sensor's valve with a straight magnet (10 N/A), no spring, and a flow that rises with the root of the
/// flow force; figures are made up.
#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::estimation {

inline sensor::CondensedParameters<double> straight_valve() {
  sensor::CondensedParameters<double> valve{};
  const auto axis = [](double spacing) { return sensor::Axis<double>{0, spacing, 1 / spacing}; };
  auto& force = valve.magnetic_force;
  force.map.row_axis = force.hysteresis_half_width_N.axis = axis(0.1);
  force.map.column_axis = axis(1e-4);
  for (int row = 0; row < force.map.rows; ++row) {
    for (int column = 0; column < force.map.columns; ++column) force.map.node(row, column) = row;
  }
  valve.spring.curve.axis = valve.friction_half_width_N.axis = axis(1e-4);
  auto& flow = valve.flow_rate;
  flow.largest_force_N.axis = flow.flow_m3_per_s.row_axis = flow.root_pressure_difference.row_axis = axis(1e-4);
  flow.flow_m3_per_s.column_axis = flow.root_pressure_difference.column_axis = axis(1.0 / 16);
  flow.largest_force_N.values.fill(40);
  for (int row = 0; row < flow.flow_m3_per_s.rows; ++row) {
    for (int column = 0; column < flow.flow_m3_per_s.columns; ++column)
      flow.flow_m3_per_s.node(row, column) = 1e-4 * column;
  }
  return valve;
}

}  // namespace spoolflow::estimation
