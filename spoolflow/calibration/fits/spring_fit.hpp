#pragma once
/// Spring force from the axial-force rig without pressure (protocol `spring`; paper section 3).
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

struct SpringFit {
  sensor::Spring<double> spring;
  std::vector<double> friction_half_width_N;  ///< over the spring's positions; the dry friction of the spool
  FitResidual residual;                       ///< of the samples about spring plus or minus half width [N]
  FitResidual even_friction_residual;         ///< about the spring, were friction the same at all positions [N]
  model::Fit known;                           ///< the curve's straight line and one dry friction both ways
  double oil_temperature_K;                   ///< mean over the recording; NaN where it was not recorded
};

/// Needs `position` and `axial_force`, strokes in both directions over the whole stroke. Throws CalibrationError.
[[nodiscard]] SpringFit fit_spring(const recording::Recording& recording, double stroke_m);

}  // namespace spoolflow::calibration
