#pragma once
/// Axial force, flow and pressure difference over position at held pressure differences, from opening and closing
/// strokes of the axial-force rig (protocol `axial_force_map`; paper section 3, Fig 5).
#include "spoolflow/calibration/fits/level.hpp"
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/evidence.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

struct AxialForceFit {
  std::vector<model::AxialForceLoop> loops;  ///< rising pressure difference
  double oil_temperature_K;                  ///< mean over the recording; NaN where it was not recorded
  FitResidual force_residual;                ///< of the samples about their own direction's curve [N]
  FitResidual flow_residual;                 ///< of the samples about their level's curve [m3/s]
};

/// The strokes of a recording sorted by the pressure difference that was held.
struct HeldPressures {
  std::vector<double> pressure_difference_Pa;  ///< of each sample
  std::vector<Level> levels;                   ///< rising
};

/// As `fit_axial_force` needs them. Throws CalibrationError.
[[nodiscard]] HeldPressures find_held_pressures(const recording::Recording& recording, double stroke_m);

/// Needs `position`, `axial_force`, `flow` (or `flow_reference`), and a pressure difference: `pressure_difference`, or
/// `pressure_upstream` and `pressure_downstream`; `pressure_difference_set` helps to distinguish the levels. At least
/// three levels, each opening and closing over the whole stroke. Throws CalibrationError.
[[nodiscard]] AxialForceFit fit_axial_force(const recording::Recording& recording, double stroke_m);

}  // namespace spoolflow::calibration
