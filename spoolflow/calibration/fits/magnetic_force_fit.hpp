#pragma once
/// Magnetic-force map F(i, x) from to-and-fro strokes at held currents (protocol `solenoid_force_map`; paper Figs 6 to
/// 8).
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/evidence.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

struct MagneticForceFit {
  sensor::MagneticForce<double> magnetic_force;
  std::vector<model::MagneticForceLoop> loops;  ///< rising current
  double largest_current_A;
  FitResidual residual;  ///< of the samples about map plus or minus half width [N]
};

/// Needs `current`, `position` and `force`; `current_set` helps to distinguish the levels. At least four held currents,
/// each to and fro over the valve's stroke. Without current the force is taken as zero. Throws CalibrationError.
[[nodiscard]] MagneticForceFit fit_magnetic_force(const recording::Recording& recording, double stroke_m);

}  // namespace spoolflow::calibration
