#pragma once
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::sensor {

inline constexpr int flow_map_positions = 49;
inline constexpr int flow_map_forces = 17;

/// What the inverse flow-force map answers.
template <class T>
struct FlowRatePoint {
  T flow_m3_per_s;
  T pressure_difference_Pa;
  bool inside;
};

/// Flow rate [m3/s] and pressure difference [Pa] over steady flow force [N] and spool position [m]: the inverse of the
/// measured flow-force map. Paper section 3, Fig 5.
///
/// At a fixed opening the steady flow force (paper (2)) grows with the square of the flow rate, so the map is kept over
/// position and the root of the force's share of the largest one measured there, in which the flow rate is nearly
/// linear. Outside the measured forces it answers at the edge. Omits temperature and the transient flow force.
template <class T>
struct FlowRate {
  Curve<T, flow_map_positions> largest_force_N;                          ///< over position [m]
  Map<T, flow_map_positions, flow_map_forces> flow_m3_per_s;             ///< over position [m], root of force share
  Map<T, flow_map_positions, flow_map_forces> root_pressure_difference;  ///< sqrt(Pa), same axes

  /// As calibrated. The sensor's step reads the same map laid out (condensed_tables.hpp).
  [[nodiscard]] constexpr FlowRatePoint<T> at(T flow_force_N, T position_m) const {
    const T share = flow_force_N / largest_force_N.at(position_m).value;
    bool inside = share >= T(0) && share <= T(1);
    const Cell<T> position = locate<flow_map_positions>(flow_m3_per_s.row_axis, position_m, [&] { inside = false; });
    const Cell<T> force = locate<flow_map_forces>(flow_m3_per_s.column_axis, sqrt(limited(share, T(0), T(1))));
    return {flow_m3_per_s.at(position, force).value, squared(root_pressure_difference.at(position, force).value),
            inside};
  }
};

}  // namespace spoolflow::sensor
