#pragma once
/// Flow over the root of the pressure difference, over position, from strokes at held pressure differences beside a
/// lagging flow meter. Every sample counts, whether the spool slides, rests or slips: what the meter shows is the flow
/// through a first-order lag, which the equations go through as well.
#include <vector>

#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

inline constexpr int conductance_positions = 49;

/// At one held pressure difference, over equally spaced positions from 0 to the stroke.
struct ConductanceLevel {
  double pressure_difference_Pa;                        ///< mean over the strokes
  std::vector<double> conductance_m3_per_s_per_rootPa;  ///< >= 0
};

struct ConductanceFit {
  double oil_temperature_K;  ///< NaN where it was not recorded
  double meter_lag_s;
  double residual_m3_per_s;  ///< RMS of what the meter showed about the fit
  double largest_m3_per_s;
  std::vector<ConductanceLevel> levels;  ///< rising
};

/// What a force rig metered beside its forces.
[[nodiscard]] ConductanceFit conductance_of(const AxialForceFit& measured);

/// Needs `position`, `flow_reference` and a pressure difference; `pressure_difference_set` helps to separate the levels
/// apart. Throws CalibrationError where there are fewer than three levels with strokes both ways.
[[nodiscard]] ConductanceFit fit_conductance(const recording::Recording& recording, double stroke_m);

}  // namespace spoolflow::calibration
