#pragma once
/// The condensed sensor's parameters, each described once: key with unit, axes with units, meaning. The model file, the
/// exported tables and the documentation all visit this.
#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::model {

/// Calls visitor.map(key, map, row_key, column_key), visitor.curve(key, curve, axis_key) and
/// visitor.number(key, value, lowest, highest) for every parameter. `Parameters` may be const.
template <class Parameters, class Visitor>
void describe_condensed(Parameters& parameters, Visitor&& visitor) {
  visitor.map("magnetic_force_N", parameters.magnetic_force.map, "current_A", "position_m");
  visitor.curve("magnetic_hysteresis_half_width_N", parameters.magnetic_force.hysteresis_half_width_N, "current_A");
  visitor.curve("spring_force_N", parameters.spring.curve, "position_m");
  visitor.curve("friction_half_width_N", parameters.friction_half_width_N, "position_m");
  visitor.curve("largest_flow_force_N", parameters.flow_rate.largest_force_N, "position_m");
  visitor.map("flow_m3_per_s", parameters.flow_rate.flow_m3_per_s, "position_m", "root_force_share");
  visitor.map("root_pressure_difference_sqrt_Pa", parameters.flow_rate.root_pressure_difference, "position_m",
              "root_force_share");
  visitor.number("closed_below_m", parameters.closed_below_m, -1e-3, 0.1);
  visitor.number("force_residual_N", parameters.force_residual_N, 0.0, 1e4);
  visitor.number("flow_residual_m3_per_s", parameters.flow_residual_m3_per_s, 0.0, 1.0);
}

/// The same of what the step reads; calls visitor.number and visitor.table(key, numbers, numbers a record).
template <class Tables, class Visitor>
void describe_condensed_tables(Tables& tables, Visitor&& visitor) {
  visitor.number("cells_per_m", tables.cells_per_m, 0.0, 1e9);
  visitor.number("cells_per_A", tables.cells_per_A, 0.0, 1e9);
  visitor.number("closed_below_cells", tables.closed_below_cells, -1e6, 1e6);
  visitor.number("twice_the_flow_residual_m3_per_s", tables.flow_residual_m3_per_s, 0.0, 2.0);
  visitor.table("records of the position cells (a line each), as CondensedLayout has them", tables.records,
                sensor::CondensedLayout::record);
}

}  // namespace spoolflow::model
