#pragma once
#include "spoolflow/calibration/magnetic_force.hpp"

namespace spoolflow::calibration {

/// Half the distance of both directions of the solenoid's force map over current [A] and position [m]: armature
/// friction, with what magnetic hysteresis adds to it while the spool moves.
[[nodiscard]] sensor::Map<double, sensor::force_map_currents, sensor::force_map_positions> armature_friction(
    const MagneticForceFit& fit);

}  // namespace spoolflow::calibration
