#pragma once

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::sensor {

inline constexpr int edge_temperatures = 3;
inline constexpr int edge_pressures = 9;
inline constexpr int edge_positions = 49;

/// No less is taken for the slope of the flow force over the pressure difference [N/Pa]: it divides forces. 1e-8 N/Pa
/// is 0.06 N at 60 bar, far below what friction leaves to be seen.
inline constexpr double least_force_per_pressure_N_Pa = 1e-8;

/// What the metering edge does at one opening, pressure difference and oil temperature.
template <class T>
struct EdgePoint {
  T flow_force_N;                  ///< steady, closing > 0
  T flow_force_per_pressure_N_Pa;  ///< its slope over the pressure difference, at least `least_force_per_pressure_N_Pa`
  T friction_N;                    ///< half width of the spool's friction, >= 0
  T friction_per_pressure_N_Pa;    ///< its slope over the pressure difference
  T conductance;                   ///< flow over the root of the pressure difference [m3/s/sqrt(Pa)]
  bool inside = true;              ///< position and pressure difference lie within what was measured; of cells that is
                                   ///< for who located them to say
  bool temperature_inside = true;  ///< the same of the oil temperature
};

/// The logarithm of a mineral oil's viscosity is linear in 1/(T - this) [K] (Vogel's equation with Cameron's constant).
inline constexpr double viscosity_origin_K = 178.15;

/// From what was measured at the highest pressure difference `measured_Pa` to a larger one: at a given opening the
/// steady flow force is in proportion to it (paper (2) with the orifice equation), friction goes on linearly (paper
/// section 2.1.3), and the conductance stays.
template <class T>
SPOOLFLOW_INLINE constexpr void continue_beyond(VolumePoint<T>& flow_force, VolumePoint<T>& friction,
                                                T pressure_difference_Pa, T measured_Pa) {
  flow_force.row_slope = flow_force.value / measured_Pa;
  flow_force.value *= pressure_difference_Pa / measured_Pa;
  friction.value += at_least_zero(friction.row_slope) * (pressure_difference_Pa - measured_Pa);
}

/// Where an oil temperature lies between the layers of an edge.
template <class T>
struct OilLayer {
  Cell<T> cell{};
  bool inside{};  ///< within what was measured
};

/// A layer that was kept: a bit that falls in its memory leads to no place outside of the tables.
template <class T>
SPOOLFLOW_INLINE constexpr Cell<T> in_tables(const Cell<T>& layer) {
  static_assert(edge_temperatures == 3, "one bit distinguishes the two cells");
  return {layer.index & (edge_temperatures - 2), layer.share};
}

/// What oil of a temperature beyond the layers adds to the share of the cell at that end: the trend of the outermost
/// layers goes on over the logarithm of viscosity.
template <class T>
SPOOLFLOW_INLINE constexpr T continued_share(const Axis<T>& temperature_K, int cell, T temperature) {
  const T place = (temperature - temperature_K.first) * temperature_K.per_spacing, beyond = place - T(2 * cell);
  return beyond - beyond * (place - T(1)) * temperature_K.spacing / (temperature - T(viscosity_origin_K));
}

/// Steady flow force (paper (2), terms 1 and 2), spool friction and flow over oil temperature [K] (layers), pressure
/// difference [Pa] (rows) and spool position [m] (columns), measured on the axial-force rig (paper section 3, Fig 5).
/// The flow force is the mean of both directions less the spring, the friction half their distance. Flow is kept as
/// conductance, Q = conductance * sqrt(dp), which is nearly free of the pressure difference. Omits the transient flow
/// force (paper (2), term 3).
template <class T>
struct MeteringEdge {
  Axis<T> temperature_K;
  Axis<T> pressure_difference_Pa;
  Axis<T> position_m;
  Volume<T, edge_temperatures, edge_pressures, edge_positions> flow_force_N;
  Volume<T, edge_temperatures, edge_pressures, edge_positions> friction_N;
  Volume<T, edge_temperatures, edge_pressures, edge_positions> conductance;

  [[nodiscard]] constexpr T highest_pressure_difference_Pa() const {
    return pressure_difference_Pa.at(edge_pressures - 1);
  }

  /// Whether a pressure difference lies above what was measured, by more than noise at the end of the axis.
  [[nodiscard]] constexpr bool is_beyond(T pressure_difference) const {
    return pressure_difference > highest_pressure_difference_Pa();
  }

  /// Oil colder or warmer than what was measured goes on by the outermost layers' trend over viscosity: the share of
  /// the cell then lies below 0 or above 1.
  [[nodiscard]] constexpr OilLayer<T> layer_at(T temperature) const {
    OilLayer<T> out{{}, true};
    out.cell = locate<edge_temperatures>(temperature_K, temperature, [&] { out.inside = false; });
    if (unlikely(!out.inside)) out.cell.share += continued_share(temperature_K, out.cell.index, temperature);
    return out;
  }

  /// In the cells that hold its oil temperature, pressure difference and position.
  [[nodiscard]] SPOOLFLOW_INLINE constexpr EdgePoint<T> at(const Cell<T>& layer, const Cell<T>& row,
                                                           const Cell<T>& column, T pressure_difference) const {
    const VolumeCell<T> cell = volume_cell(layer, row, column, pressure_difference_Pa.per_spacing);
    VolumePoint<T> force = flow_force_N.at(cell), friction = friction_N.at(cell);
    if (unlikely(row.index == edge_pressures - 2 && is_beyond(pressure_difference)))
      continue_beyond(force, friction, pressure_difference, highest_pressure_difference_Pa());
    return {force.value, larger(force.row_slope, T(least_force_per_pressure_N_Pa)), friction.value, friction.row_slope,
            conductance.at(cell).value};
  }
  /// The layer may be kept while the oil temperature stays. `outside()` is called where pressure difference or position
  /// lie outside of what was measured.
  template <class Outside>
  [[nodiscard]] SPOOLFLOW_INLINE constexpr EdgePoint<T> at(const Cell<T>& layer, T pressure_difference, T position,
                                                           const Outside& outside) const {
    const Cell<T> row = locate<edge_pressures>(pressure_difference_Pa, pressure_difference, outside);
    const Cell<T> column = locate<edge_positions>(position_m, position, outside);
    return at(in_tables(layer), row, column, pressure_difference);
  }
  [[nodiscard]] SPOOLFLOW_INLINE constexpr EdgePoint<T> at(const Cell<T>& layer, T pressure_difference,
                                                           T position) const {
    return at(layer, pressure_difference, position, [] {});
  }
  [[nodiscard]] SPOOLFLOW_INLINE constexpr EdgePoint<T> at(T temperature, T pressure_difference, T position) const {
    const OilLayer<T> layer = layer_at(temperature);
    bool inside = true;
    EdgePoint<T> out = at(layer.cell, pressure_difference, position, [&] { inside = false; });
    out.inside = inside;
    out.temperature_inside = layer.inside;
    return out;
  }
  /// The conductance there. A call of its own: asked where no force is used.
  [[nodiscard]] SPOOLFLOW_NOINLINE constexpr T conductance_at(const Cell<T>& layer, T pressure_difference,
                                                              T position) const {
    return at(layer, pressure_difference, position).conductance;
  }
};

}  // namespace spoolflow::sensor
