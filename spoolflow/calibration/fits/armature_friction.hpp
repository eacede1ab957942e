#pragma once
/// What strokes of the armature both ways show of its friction, apart from magnetic hysteresis.
#include <vector>

#include "spoolflow/calibration/fits/magnetic_force_fit.hpp"
#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/coil.hpp"

namespace spoolflow::calibration {

using FrictionMap = sensor::Map<double, sensor::force_map_currents, sensor::force_map_positions>;

struct ArmatureFrictionFit {
  FrictionMap friction_N;                        ///< half width over current and position, >= 0
  sensor::MagneticForce<double> magnetic_force;  ///< over magnetising current, both directions averaged
  model::Fit known;                              ///< friction as a constant and a share of the magnetic force
  FitResidual residual;                          ///< of the strokes about both [N]
  std::vector<model::MapResidual> profiles;      ///< the same over position, each held current by itself
};

/// Runs the coil along the recording of `solenoid_force_map`, so that the force of each stroke stands over its
/// magnetising current; what then differs between the directions is friction.
[[nodiscard]] ArmatureFrictionFit fit_armature_friction(const SolenoidSamples& samples, const MagneticForceFit& map,
                                                        const sensor::Coil<double>& coil, double stroke_m);

/// How the loops' half widths part, where no current loops were recorded: friction as a constant and a share of the
/// magnetic force (the side load of the armature), and a coercive current times the force's slope over current.
struct LoopWidths {
  double constant_N;
  double per_force;
  double coercive_current_A;
  model::Fit known;
  FitResidual residual;  ///< [N]
};
[[nodiscard]] LoopWidths part_loop_widths(const MagneticForceFit& map);

}  // namespace spoolflow::calibration
