#pragma once
/// The condensed sensor's parameters, each described once (parameter.hpp). Model file, exports, load check and
/// documentation all visit this.
#include "spoolflow/model/describe_axes.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::model {

template <class MagneticForce, class Visitor>
void describe_magnetic_force(MagneticForce& magnetic_force, Visitor& visitor) {
  visitor.map({.key = "magnetic_force_N",
               .unit = "N",
               .limits = {-1e4, 1e4},
               .meaning = "magnetic force, opening > 0, mean of both directions",
               .rows = current_axis,
               .columns = position_axis},
              magnetic_force.map);
  visitor.curve({.key = "magnetic_hysteresis_half_width_N",
                 .unit = "N",
                 .limits = {0, 1e4},
                 .meaning = "half-width of the magnetic force's loop",
                 .columns = current_axis},
                magnetic_force.hysteresis_half_width_N);
}

template <class Spring, class Visitor>
void describe_spring(Spring& spring, Visitor& visitor) {
  visitor.curve({.key = "spring_force_N",
                 .unit = "N",
                 .limits = {-1e4, 1e4},
                 .meaning = "all springs with their preload, closing > 0",
                 .columns = position_axis},
                spring.curve);
}

template <class FlowRate, class Visitor>
void describe_flow_rate(FlowRate& flow_rate, Visitor& visitor) {
  visitor.curve({.key = "largest_flow_force_N",
                 .unit = "N",
                 .limits = {1e-4, 1e4},
                 .meaning = "largest measured flow force at each position",
                 .columns = position_axis,
                 .relation = alike(1e4)},
                flow_rate.largest_force_N);
  visitor.map({.key = "flow_m3_per_s",
               .unit = "m3/s",
               .limits = {-0.1, 1},
               .meaning = "flow rate over the root of the flow force's share in the largest one",
               .rows = position_axis,
               .columns = root_force_share_axis,
               .relation = never_falls},
              flow_rate.flow_m3_per_s);
  visitor.map({.key = "root_pressure_difference_sqrt_Pa",
               .unit = "Pa(1/2)",
               .limits = {-1e3, 1e5},
               .meaning = "root of the pressure difference, over the same",
               .rows = position_axis,
               .columns = root_force_share_axis},
              flow_rate.root_pressure_difference);
}

/// Calls visitor.map(TableParameter, map), visitor.curve(TableParameter, curve) and visitor.number(Parameter, value)
/// for every parameter. `Parameters` may be const.
template <class Parameters, class Visitor>
void describe_condensed(Parameters& parameters, Visitor&& visitor) {
  describe_magnetic_force(parameters.magnetic_force, visitor);
  describe_spring(parameters.spring, visitor);
  visitor.curve({.key = "friction_half_width_N",
                 .unit = "N",
                 .limits = {0, 1e4},
                 .meaning = "half-width of the axial force's loop",
                 .columns = position_axis},
                parameters.friction_half_width_N);
  describe_flow_rate(parameters.flow_rate, visitor);
  visitor.number({"closed_below_m", "m", {-1e-3, 0.1}, "positions below this count as closed"},
                 parameters.closed_below_m);
  visitor.number({"force_residual_N", "N", {0, 1e4}, "standard deviation of the averaged forces about the maps"},
                 parameters.force_residual_N);
  visitor.number({"flow_residual_m3_per_s", "m3/s", {0, 1}, "standard deviation of the flow about its map"},
                 parameters.flow_residual_m3_per_s);
}

/// The same of what the step reads; calls visitor.number and visitor.table(what it is, numbers, numbers a record).
template <class Tables, class Visitor>
void describe_condensed_tables(Tables& tables, Visitor&& visitor) {
  visitor.number({"cells_per_m", "1/m", {0, 1e9}, "position cells"}, tables.cells_per_m);
  visitor.number({"cells_per_A", "1/A", {0, 1e9}, "current cells"}, tables.cells_per_A);
  visitor.number({"closed_below_cells", "1", {-1e6, 1e6}, "positions below this count as closed"},
                 tables.closed_below_cells);
  visitor.number(
      {"twice_the_flow_residual_m3_per_s", "m3/s", {0, 2}, "two standard deviations of the flow about its map"},
      tables.flow_residual_m3_per_s);
  visitor.table("records of the position cells (a line each), as CondensedLayout has them", tables.records,
                sensor::CondensedLayout::record);
}

}  // namespace spoolflow::model
