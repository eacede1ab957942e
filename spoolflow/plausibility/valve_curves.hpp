#pragma once
/// One direction of a valve in few numbers, straight from its bench recordings: spring, flow force, flow and magnetic
/// force over few knots. Too coarse for a sensor, true enough to show a recording error from a measurement.
#include <algorithm>
#include <vector>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

inline double squared(double value) {
  return value * value;
}

/// Of spring and axial-force recordings: axial force = S(x) + g(x) dp + friction with the direction of motion,
/// flow = C(x) sqrt(dp) (paper sections 2 and 3).
struct HydraulicCurves {
  double stroke_m = 0;
  std::vector<double> spring_N;       ///< over position, closing > 0
  std::vector<double> force_per_Pa;   ///< flow force over pressure difference, closing > 0
  std::vector<double> conductance;    ///< flow over the root of the pressure difference [m3/s/sqrt(Pa)]
  double force_residual_N = 0;        ///< RMS of the recording that fits worst
  double force_range_N = 0;           ///< of all axial forces
  double flow_residual_m3_per_s = 0;  ///< RMS
  double largest_flow_m3_per_s = 0;   ///< without sign
  double friction_N = 0;              ///< half width
  double highest_pressure_Pa = 0;     ///< measured
  double bounding_pressure_Pa = 0;    ///< that the machine may have, where it is higher
  double jet_momentum_share = 0;      ///< flow force over rho Q sqrt(2 dp / rho): the cosine of the jet's angle, nearly

  [[nodiscard]] double highest_bound_Pa() const { return std::max(highest_pressure_Pa, bounding_pressure_Pa); }
  [[nodiscard]] double spring_at(double position_m) const;
  [[nodiscard]] double force_per_Pa_at(double position_m) const;
  [[nodiscard]] double conductance_at(double position_m) const;
};

/// `spring` and `maps` are block means of their protocols; `spring` may be null. Needs stroke and density > 0.
[[nodiscard]] HydraulicCurves fit_hydraulics(const recording::Recording* spring,
                                             const std::vector<const recording::Recording*>& maps, double stroke_m,
                                             double density_kg_per_m3);

/// What a map has over the curves of all, at the same opening and pressure difference; NaN where too few blocks show
/// it.
struct MapRatios {
  double flow, flow_force;
};
/// `map` is block means.
[[nodiscard]] MapRatios map_ratios(const HydraulicCurves& curves, const recording::Recording& map);

/// Of the solenoid's force map: force over current and position (paper Figs 6 to 8), both directions averaged.
struct MagneticCurves {
  double stroke_m = 0;
  double largest_current_A = 0;
  std::vector<double> force_N;
  double residual_N = 0;  ///< RMS
  double range_N = 0;     ///< of all forces
  double mean_N = 0;      ///< of all knots
  bool rises = false;     ///< from each current to the next, over all positions

  [[nodiscard]] double at(double current_A, double position_m) const;
};

/// `map` is block means.
[[nodiscard]] MagneticCurves fit_magnetics(const recording::Recording& map, double stroke_m);

}  // namespace spoolflow::plausibility
