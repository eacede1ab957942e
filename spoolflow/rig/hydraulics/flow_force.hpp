#pragma once
/// Force of the oil on the spool, one metering edge; closing > 0. Paper, equation (2), for each active edge:
///
///     F = rho Q^2 cos(e1)/(A1 sin e1) - rho Q^2 cos(e2)/(A2 sin e2) - rho l dQ/dt
///
/// with A1 sin(e1) = Cc A the jet's cross-section behind the metering area. The jet angle e1 follows von Mises' slot
/// between opening and clearance; the clearance that counts is widened by edge radius and boundary
/// layer, d = gain sqrt(nu o/u), so cold oil bends the jet towards the axis and closes harder. The lateral part rho Q u
/// sin(e1) presses the spool to its bore by the share that the notches do not balance. Leakage carries no momentum
/// here.
#include "spoolflow/rig/hydraulics/metering_edge.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

/// Angle of the jet behind a metering edge, from the spool axis, by opening o and clearance c (von Mises; Merritt
/// 1967):
///
///     o/c = [1 + pi/2 sin e - ln tan((pi - e)/2) cos e] / [1 + pi/2 cos e - ln tan((pi/2 + e)/2) sin e]
///
/// 21.1 deg at o << c, 45 deg at o = c, 68.9 deg at o >> c. The inverse is taken from a fit that keeps the exchange of
/// opening and clearance (e -> 90 deg - e): with y = (o - c)/(o + c), tan(e - 45 deg) = y (a0 + a1 y^2 + a2 y^4 + a3
/// y^6), within 0.004 deg of the exact angle over the whole range (the coefficients' residual; checked by a test).
template <class Scalar>
struct JetDirectionOf {
  Scalar cosine;
  Scalar sine;
};
using JetDirection = JetDirectionOf<double>;

template <class Scalar>
inline JetDirectionOf<Scalar> jet_direction(Scalar opening_m, Scalar clearance_m) {
  const Scalar y = (opening_m - clearance_m) / (opening_m + clearance_m);
  const Scalar y2 = y * y;
  const Scalar t = y * (0.54390398 + y2 * (-0.14449791 + y2 * (0.05774067 - 0.01473432 * y2)));
  const Scalar scale = 1.0 / square_root(2.0 * (1.0 + t * t));
  return {(1.0 - t) * scale, (1.0 + t) * scale};
}

template <class Scalar>
struct FlowForceOf {
  Scalar jet_contraction = 0.75;
  Scalar boundary_layer_gain = 8.0;
  Scalar lateral_friction = 0.035;
  Scalar friction_per_pressure_N_per_Pa = 1.7e-7;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"jet_contraction", "1", 0.5, 1, "jet over metering area; sharp edges 0.61 to 0.8"},
          self.jet_contraction);
    visit(Parameter{"boundary_layer_gain", "1", 0, 20,
                    "Blasius 1.7 for one wall, two walls and the start of the jet more"},
          self.boundary_layer_gain);
    visit(Parameter{"lateral_friction", "1", 0, 0.2,
                    "unbalanced share of the lateral jet force times friction coefficient"},
          self.lateral_friction);
    visit(
        Parameter{
            "friction_per_pressure_N_per_Pa", "N/Pa", 0, 2e-6,
            "spool friction from radial pressure, linear in the pressure difference (Lu and Tiainen): 1 N at 60 bar"},
        self.friction_per_pressure_N_per_Pa);
  }
};
using FlowForce = FlowForceOf<double>;

/// Transient force [N] -rho l dQ/dt, closing > 0. The oil in the chamber cannot be pushed harder than by the pressure
/// difference on its cross-section, dp A_chamber, into which the force runs (hundreds of newtons at size 6).
template <class Scalar>
inline Scalar transient_force_N(const EdgeConstantsOf<Scalar>& constants, Scalar density_kg_per_m3,
                                Scalar damping_length_m, Scalar flow_rate_m3_per_s2, Scalar pressure_difference_Pa) {
  const Scalar force = -density_kg_per_m3 * damping_length_m * flow_rate_m3_per_s2;
  const Scalar limit = magnitude(pressure_difference_Pa) * constants.chamber_area_m2 + 1.0;
  return force * limit / square_root(limit * limit + force * force);
}

template <class Scalar>
struct EdgeForceOf {
  Scalar steady_N;   ///< closing > 0, whichever way the oil flows
  Scalar lateral_N;  ///< magnitude
  JetDirectionOf<Scalar> jet;
};
using EdgeForce = EdgeForceOf<double>;

template <class Scalar>
inline EdgeForceOf<Scalar> edge_force(const FlowForceOf<Scalar>& law, const EdgeConstantsOf<Scalar>& constants,
                                      const EdgeFlowOf<Scalar>& edge, Scalar viscosity_m2_per_s) {
  const EdgeForceOf<Scalar> none{0.0, 0.0, {1.0, 0.0}};
  const Mask<Scalar> flows = !(edge.velocity_m_per_s == 0.0);
  if (!any(flows)) return none;
  const Scalar speed = magnitude(edge.velocity_m_per_s) + 1e-3;  // the boundary layer stays finite at no flow
  const Scalar boundary_layer = law.boundary_layer_gain * square_root(viscosity_m2_per_s * edge.opening_m / speed);
  const JetDirectionOf<Scalar> jet = jet_direction(edge.opening_m, constants.clearance_m + boundary_layer);
  const Scalar momentum = 2.0 * constants.turbulent * edge.area_m2 * edge.velocity_m_per_s * edge.velocity_m_per_s;
  const Scalar jet_momentum = momentum / law.jet_contraction;
  return blended(
      flows,
      EdgeForceOf<Scalar>{.steady_N = jet_momentum * jet.cosine - momentum * edge.area_m2 * constants.outlet_per_m2,
                          .lateral_N = jet_momentum * jet.sine,
                          .jet = jet},
      none);
}

}  // namespace spoolflow::rig
