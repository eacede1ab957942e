#pragma once
#include "spoolflow/sensor/table.hpp"

namespace spoolflow::sensor {

inline constexpr int spring_positions = 33;

/// Spring force [N], closing > 0, over spool position [m]: all springs between housing, spool and armature together,
/// with their preload. Paper (1), F_spr; measured on the axial-force rig without pressure, friction averaged out.
template <class T>
struct Spring {
  Curve<T, spring_positions> curve;

  [[nodiscard]] constexpr CurvePoint<T> at(T position_m) const { return curve.at(position_m); }
};

}  // namespace spoolflow::sensor
