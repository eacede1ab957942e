#pragma once
/// Forces that tables hold: the solenoid's and the springs'.
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::sensor {

inline constexpr int force_map_currents = 33;
inline constexpr int force_map_positions = 33;

/// Magnetic force [N], opening > 0, over coil current [A] (rows) and spool position [m] (columns), both directions of
/// motion averaged. Paper section 3, Fig 8. Omits hysteresis, eddy currents and armature friction, whose joint half
/// width is the uncertainty beside it.
template <class T>
struct MagneticForce {
  Map<T, force_map_currents, force_map_positions> map;
  Curve<T, force_map_currents> hysteresis_half_width_N;  ///< over current [A], largest over position

  [[nodiscard]] constexpr MapPoint<T> at(T current_A, T position_m) const { return map.at(current_A, position_m); }
};

inline constexpr int spring_positions = 33;

/// Spring force [N], closing > 0, over spool position [m]: all springs between housing, spool and armature together,
/// with their preload. Paper (1), F_spr; measured on the axial-force rig without pressure, friction averaged out.
template <class T>
struct Spring {
  Curve<T, spring_positions> curve;

  [[nodiscard]] constexpr CurvePoint<T> at(T position_m) const { return curve.at(position_m); }
};

}  // namespace spoolflow::sensor
