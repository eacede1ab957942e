#pragma once
/// What a sensor's tables must be for its equations to live with them: axes that rise in the steps that they state, and
/// above zero what is so in every valve. The full limits of a model are held by the tool that reads and exports it.
#include "spoolflow/sensor/condensed_tables.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"
#include "spoolflow/sensor/parameter_image/image_refusal.hpp"

namespace spoolflow::sensor {

namespace detail {

/// From no number at all on, nothing rises.
constexpr bool rises(const Axis<float>& axis) {
  constexpr float tolerance = 1e-5F;  // spacing and 1 / spacing are both rounded
  const float one = axis.spacing * axis.per_spacing;
  return axis.spacing > 0.0F && axis.per_spacing > 0.0F && magnitude(one - 1.0F) < tolerance;
}
template <int Points>
constexpr bool rises(const Curve<float, Points>& curve) {
  return rises(curve.axis);
}
template <int Rows, int Columns>
constexpr bool rises(const Map<float, Rows, Columns>& map) {
  return rises(map.row_axis) && rises(map.column_axis);
}

/// Whether a map rises along its rows' axis in each column.
template <int Rows, int Columns>
constexpr bool rises_over_rows(const Map<float, Rows, Columns>& map) {
  for (int column = 0; column < Columns; ++column) {
    for (int row = 1; row < Rows; ++row) {
      if (!(map.node(row, column) > map.node(row - 1, column))) return false;
    }
  }
  return true;
}

/// Thresholds of the stops, which the observer takes to ascend from above zero.
constexpr bool ascend(const MagneticHysteresis<float>& hysteresis) {
  float before = 0.0F;
  for (const float threshold : hysteresis.threshold) {
    if (!(threshold > before)) return false;
    before = threshold;
  }
  return true;
}

}  // namespace detail

constexpr ImageRefusal sanity(const CondensedTables<float>& valve) {
  if (!(valve.cells_per_m > 0.0F && valve.cells_per_A > 0.0F)) return ImageRefusal::axis_not_rising;
  return valve.flow_residual_m3_per_s >= 0.0F ? ImageRefusal::none : ImageRefusal::not_physical;
}

constexpr ImageRefusal sanity(const ObserverParameters<float>& valve) {
  using detail::rises;
  const ActuatorParameters<float>& actuator = valve.actuator;
  const bool axes_rise = rises(actuator.magnetic_force.map) && rises(actuator.magnetic_force.hysteresis_half_width_N) &&
                         rises(actuator.coil.flux_linkage.map) && rises(actuator.friction_N) &&
                         rises(valve.spring.curve) && rises(valve.edge.temperature_K) &&
                         rises(valve.edge.pressure_difference_Pa) && rises(valve.edge.position_m);
  if (!axes_rise) return ImageRefusal::axis_not_rising;
  const bool physical = detail::rises_over_rows(actuator.coil.flux_linkage.map) &&
                        detail::ascend(actuator.coil.hysteresis) &&
                        actuator.coil.eddy_currents.smallest_rate_V > 0.0F && valve.friction.ageing_s > 0.0F &&
                        valve.moving_mass_kg > 0.0F && valve.edge.highest_pressure_difference_Pa() > 0.0F;
  return physical ? ImageRefusal::none : ImageRefusal::not_physical;
}

}  // namespace spoolflow::sensor
