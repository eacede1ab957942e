#pragma once
/// The open path as the load will use it: two metering edges in series, of which the outlet passes k times the inlet's
/// flow. With C1, C2 the conductances of inlet and outlet and q the flow through the inlet,
///
///     dp = dp1 + dp2,   dp1 = q^2/C1^2,   dp2 = k^2 q^2/C2^2,   C = q/sqrt(dp) = 1/sqrt(1/C1^2 + k^2/C2^2)
///     F = F1(dp1) + F2(dp2)                         steady flow forces, each closing its own edge
///     f = f0 + (f1(dp1) - f0) + (f2(dp2) - f0)      spool friction; f0 without pressure, counted once
///
/// k is the cylinder's area ratio r (port A over port B) while B is fed, 1/r while A is. Where both edges were measured
/// together with k = 1 and the load has another, the edges are taken to be in one proportion e = C2/C1 over the whole
/// stroke, each with a force in proportion to C dp:
///
///     C/C_joined = sqrt((e^2 + 1)/(e^2 + k^2)),   F/F_joined = (e + k^2)/(e + 1) (e^2 + 1)/(e^2 + k^2)   at the same
///     dp
///
///     dp1/dp = e^2/(e^2 + k^2)
///
/// No such bench measures e; a run at work whose flow and pressure difference were recorded does
/// (edges_in_operation.hpp). Else it is taken as 1, both edges alike: C/C_joined = sqrt(2/(1 + k^2)), F as it was.
/// Edges cut for their cylinder have e = k; what lies between both is what the flow may be wrong by.
#include <optional>
#include <vector>

#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/force_maps.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::calibration {

/// e = C2/C1, and the range in which it lies at 95 %.
struct EdgeRatio {
  double value, lowest, highest;
};

/// How a direction's axial force was measured: both edges of its path together, or each by itself.
struct AxialForceMaps {
  std::vector<const recording::Recording*> joined;  ///< one an oil temperature; or
  std::vector<const recording::Recording*> inlet;   ///< of P to B or P to A alone,
  std::vector<const recording::Recording*> outlet;  ///< and of A to T or B to T
  double outlet_flow_ratio = 1;                     ///< flow over the outlet through that through the inlet, > 0
  std::optional<EdgeRatio> edge_ratio;              ///< of joined edges, where operation identified it

  /// All of them.
  [[nodiscard]] std::vector<const recording::Recording*> recordings() const;
  /// The load passes unequal flows over edges that were measured together.
  [[nodiscard]] bool edges_are_unknown() const { return inlet.empty() && outlet_flow_ratio != 1; }
  [[nodiscard]] bool edges_are_assumed() const { return edges_are_unknown() && !edge_ratio; }
};

/// The path's loops, as a bench with that load would measure them, from those of its edges at the same oil temperature.
/// Their levels are in proportion to the inlet's, the highest so high that both edges have what they were measured at:
/// of two like edges twice as much as of each.
[[nodiscard]] AxialForceFit path_of_edges(const AxialForceFit& inlet, const AxialForceFit& outlet,
                                          const sensor::Spring<double>& spring, double outlet_flow_ratio);

/// What a direction's recordings determine of its path, one fit an oil temperature.
struct PathFit {
  std::vector<std::vector<AxialForceFit>> measured;  ///< of both edges joined, or of inlet and outlet
  std::vector<AxialForceFit> path;                   ///< as the load uses it
  bool equal_flows = true;                           ///< the load passes the same flow over both edges
  sensor::InletShare<double> inlet;                  ///< dp1/dp; a half, with a wide range, where e is unknown
};

/// Each inlet is taken together with the outlet at the nearest oil temperature. Throws CalibrationError where an edge
/// was measured at an oil temperature at which the other was not, within 5 K, or no oil flows through one fully open.
[[nodiscard]] PathFit fit_path(const AxialForceMaps& maps, const sensor::Spring<double>& spring, double stroke_m);

/// A path measured with both edges joined, under a load that passes k times the flow over the outlet; e = C2/C1. With
/// k < 1 the cylinder multiplies the return's pressure, and the path has up to 2/(1 + k) of what the supply holds above
/// tank: the loops are then carried on to there from the highest level.
[[nodiscard]] AxialForceFit joined_under_load(AxialForceFit joined, const sensor::Spring<double>& spring,
                                              double outlet_flow_ratio, double edge_ratio);

/// C/C_joined as above, and e from it; C/C_joined lies between 1 and 1/k.
[[nodiscard]] double conductance_under_load(double outlet_flow_ratio, double edge_ratio);
[[nodiscard]] double edge_ratio_of(double outlet_flow_ratio, double conductance_share);

/// What the band's flow residual becomes where each edge by itself is not known [m3/s]: the band then holds what the
/// flow that belongs to one force would be at rated flow with edges in another proportion: up to e = k where they were
/// assumed alike, within the range of e where operation identified it.
[[nodiscard]] double flow_residual_with_unknown_edges(const AxialForceMaps& maps, double flow_residual_m3_per_s,
                                                      double rated_flow_m3_per_s);

}  // namespace spoolflow::calibration
