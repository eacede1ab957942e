#pragma once
/// Friction of whatever slides, identified from its position and the force that drives it.
#include <span>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/numerics/fit_residual.hpp"

namespace spoolflow::calibration {

/// force = mass * acceleration + viscous * velocity + coulomb * sign(velocity) + offset, velocity > 0 while opening.
/// Omits stiction, pre-sliding and the Stribeck dip: valid while sliding.
struct FrictionLaw {
  double mass_kg = 0;
  double viscous_opening_N_s_per_m = 0;
  double viscous_closing_N_s_per_m = 0;
  double coulomb_opening_N = 0;
  double coulomb_closing_N = 0;
  double offset_N =
      0;  ///< what drives one way at rest; distinguished from friction only if both directions have one law
};

/// Whether both directions share one friction, with an offset; or each has its own, the offset within.
enum class FrictionSymmetry { same_both_ways, by_direction };

/// What moves: strokes so slow and even that only dry friction shows, or motion that shows inertia and viscosity too.
enum class FrictionMotion { even_strokes, accelerated };

/// A history at even time steps. NaN where a sample is missing.
struct SlidingHistory {
  std::span<const double> position_m;
  std::span<const double> force_N;  ///< driving force, > 0 opens
  double time_step_s;
  double bandwidth_Hz;               ///< of what is to be seen in position; noise lies above
  std::span<const Sweep> stretches;  ///< the samples that are judged, whichever way they travel
};

struct SlidingFrictionFit {
  FrictionLaw law;
  FrictionLaw uncertainty;  ///< one standard deviation each, from the residual
  FitResidual residual;     ///< [N], at the rows of the fit
  double force_rms_N;       ///< of the same rows
};

/// Linear least squares on filtered derivatives: position smoothed without lag and differentiated, then regressors and
/// force alike smoothed to two fifths of the bandwidth. Throws CalibrationError where the motion does not show all
/// parameters. Gautier, Dynamic identification of robots with power model (1997).
[[nodiscard]] SlidingFrictionFit fit_sliding_friction(const SlidingHistory& history, FrictionSymmetry symmetry,
                                                      FrictionMotion motion);

}  // namespace spoolflow::calibration
