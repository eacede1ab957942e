#pragma once
/// One metering edge: notch geometry, overlap, clearance and wear; its flow by pressure difference.
///
///     o = s - overlap                                   (s the travel that opens)
///     o+ = 0 below -c', (o + c')^2/(4 c') around 0, o above c';   c' = c + r, clearance and edge radius
///     A = n (w o+ + tan(theta) o+^2)
///     dp = rho/2 (Q_n/(Cd A))^2 (1 + Re_t/Re) + rho/2 (Q_n/A_channel)^2,   Re = 2 o+ Q_n/(A nu)
///     Q_leak = (pi D c^3 (1 + 1.5 ecc^2)/(12 rho nu L) + g_scratch) dp,  L = L_s + max(0, -o)
///
/// Turbulent and laminar loss in series make the discharge coefficient Cd sqrt(Re/(Re + Re_t)): smooth through zero
/// flow and odd in dp. A worn (rounded) edge opens earlier and contracts the jet less: Cd -> Cd + (0.95 - Cd) r/(r +
/// o+). Leaves out the end of the notches and choking by cavitation.
#include <numbers>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct MeteringEdgeOf {
  Scalar overlap_m = 0.15e-3;
  Scalar notches = 4.0;
  Scalar notch_width_m = 1.08e-3;
  Scalar notch_flank = 0.31;
  Scalar discharge_coefficient = 0.68;
  Scalar transition_reynolds = 60.0;
  Scalar sealing_length_m = 0.2e-3;
  Scalar channel_area_m2 = 2.6e-5;
  Scalar outlet_area_m2 = 1.2e-4;
  Scalar outlet_cotangent = 0.18;
  Scalar damping_length_m = 12.0e-3;
  Scalar edge_radius_m = 2.0e-6;
  Scalar clearance_eccentricity = 0.5;
  Scalar scratch_m3_per_s_Pa = 0.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"overlap_m", "m", 2e-5, 1e-3, "positive overlap of proportional valves: 5 to 20 % of the stroke"},
          self.overlap_m);
    visit(Parameter{"notches", "1", 1, 12, "on the land's circumference"}, self.notches);
    visit(Parameter{"notch_width_m", "m", 1e-4, 6e-3, "each, at its tip"}, self.notch_width_m);
    visit(Parameter{"notch_flank", "1", 0, 1.5, "tangent of the notch's flank: both widen it by 2 tan per opening"},
          self.notch_flank);
    visit(Parameter{"discharge_coefficient", "1", 0.5, 0.95, "sharp edge, turbulent: 0.6 to 0.75"},
          self.discharge_coefficient);
    visit(Parameter{"transition_reynolds", "1", 1, 500,
                    "where the laminar loss equals the turbulent; sharp edges 10 to 100"},
          self.transition_reynolds);
    visit(Parameter{"sealing_length_m", "m", 2e-5, 5e-3, "land left beside the notches when they are open"},
          self.sealing_length_m);
    visit(Parameter{"channel_area_m2", "m2", 5e-6, 2e-3, "orifice area equivalent to the bores of the body in series"},
          self.channel_area_m2);
    visit(Parameter{"outlet_area_m2", "m2", 1e-5, 5e-3, "A2 of the paper's equation (2): chamber to port"},
          self.outlet_area_m2);
    visit(Parameter{"outlet_cotangent", "1", 0, 1, "cot e2 of the paper's equation (2); 80 deg from the spool axis"},
          self.outlet_cotangent);
    visit(Parameter{"damping_length_m", "m", -0.03, 0.03,
                    "l of the paper's equation (2); sign by flow direction in the chamber"},
          self.damping_length_m);
    visit(Parameter{"edge_radius_m", "m", 0, 1e-4, "ground edge 1 to 5 micrometres; worn edges tens of micrometres"},
          self.edge_radius_m);
    visit(Parameter{"clearance_eccentricity", "1", 0, 1, "spool in its bore, for leakage"},
          self.clearance_eccentricity);
    visit(Parameter{"scratch_m3_per_s_Pa", "m3/(s Pa)", 0, 1e-11,
                    "leakage along scratches of the land, whatever the opening; 8.3e-13 is 0.3 L/min at 60 bar"},
          self.scratch_m3_per_s_Pa);
  }
};
using MeteringEdge = MeteringEdgeOf<double>;

/// What does not change within a step: the edge in its oil.
template <class Scalar>
struct EdgeConstantsOf {
  Scalar clearance_m;          ///< c' of the opening
  Scalar turbulent;            ///< rho/2: dp = turbulent (1/Cd^2 + (A/A_channel)^2) u^2 ...
  Scalar laminar;              ///< ... + laminar/(Cd^2 o+) u, with u = Q_n/A
  Scalar leakage;              ///< Q_leak L/dp [m4/(s Pa)]
  Scalar outlet_per_m2;        ///< cot(e2)/A2
  Scalar per_channel_area_m2;  ///< 1/A_channel
  Scalar chamber_area_m2;      ///< ring between spool neck and bore, half the bore's cross-section
};
using EdgeConstants = EdgeConstantsOf<double>;

template <class Scalar>
inline EdgeConstantsOf<Scalar> edge_constants(const MeteringEdgeOf<Scalar>& edge, Scalar bore_diameter_m,
                                              Scalar clearance_m, Scalar density_kg_per_m3, Scalar viscosity_m2_per_s) {
  return {.clearance_m = clearance_m + edge.edge_radius_m,
          .turbulent = 0.5 * density_kg_per_m3,
          .laminar = 0.25 * density_kg_per_m3 * viscosity_m2_per_s * edge.transition_reynolds,
          .leakage = std::numbers::pi * bore_diameter_m * clearance_m * clearance_m * clearance_m *
                     (1.0 + 1.5 * edge.clearance_eccentricity * edge.clearance_eccentricity) /
                     (12.0 * density_kg_per_m3 * viscosity_m2_per_s),
          .outlet_per_m2 = edge.outlet_cotangent / edge.outlet_area_m2,
          .per_channel_area_m2 = 1.0 / edge.channel_area_m2,
          .chamber_area_m2 = 0.125 * std::numbers::pi * bore_diameter_m * bore_diameter_m};
}

/// Flow through one edge and its slopes.
template <class Scalar>
struct EdgeFlowOf {
  Scalar opening_m;         ///< o+
  Scalar area_m2;           ///< A
  Scalar velocity_m_per_s;  ///< u = Q_n/A, with the sign of dp
  Scalar leakage_m3_per_s;
  Scalar flow_m3_per_s;            ///< Q_n + Q_leak
  Scalar conductance_m3_per_s_Pa;  ///< dQ/d(dp) > 0
  Scalar flow_gain_m2_per_s;       ///< dQ/ds
};
using EdgeFlow = EdgeFlowOf<double>;

template <class Scalar>
inline EdgeFlowOf<Scalar> edge_flow(const MeteringEdgeOf<Scalar>& edge, const EdgeConstantsOf<Scalar>& constants,
                                    Scalar travel_m, Scalar pressure_difference_Pa) {
  const Scalar o = travel_m - edge.overlap_m;
  const Scalar per_length = 1.0 / (edge.sealing_length_m + larger(Scalar(0.0), -o));
  const Scalar land_conductance = constants.leakage * per_length;
  const Scalar leakage_conductance = land_conductance + edge.scratch_m3_per_s_Pa;
  const Scalar leakage = leakage_conductance * pressure_difference_Pa;
  const Scalar leakage_gain = select(o < 0.0, land_conductance * pressure_difference_Pa * per_length, Scalar(0.0));
  const Scalar c = constants.clearance_m;
  const EdgeFlowOf<Scalar> closed{0.0, 0.0, 0.0, leakage, leakage, leakage_conductance, leakage_gain};
  const Mask<Scalar> open = !(o <= -c);
  if (!any(open)) return closed;

  Scalar opening = o;
  Scalar opening_slope = 1.0;
  if (const Mask<Scalar> barely = o < c; any(barely)) {
    opening_slope = select(barely, (o + c) / (2.0 * c), opening_slope);
    opening = select(barely, c * opening_slope * opening_slope, opening);
  }
  const Scalar width = edge.notches * (edge.notch_width_m + edge.notch_flank * opening);
  const Scalar area = opening * width;
  const Scalar area_slope = width + edge.notches * edge.notch_flank * opening;

  const Scalar per_rounded = 1.0 / (edge.edge_radius_m + opening);
  const Scalar rounding = (0.95 - edge.discharge_coefficient) * edge.edge_radius_m * per_rounded;
  const Scalar per_discharge = 1.0 / (edge.discharge_coefficient + rounding);
  const Scalar loss = per_discharge * per_discharge;
  const Scalar loss_slope = 2.0 * loss * per_discharge * rounding * per_rounded;
  const Scalar channel = area * constants.per_channel_area_m2;

  const Scalar per_opening = 1.0 / opening;
  const Scalar quadratic = constants.turbulent * (loss + channel * channel);
  const Scalar linear = constants.laminar * loss * per_opening;
  const Scalar slope = square_root(linear * linear + 4.0 * quadratic * magnitude(pressure_difference_Pa));
  const Scalar per_slope = 1.0 / slope;
  const Scalar u = 2.0 * pressure_difference_Pa / (linear + slope);
  const Scalar quadratic_slope =
      constants.turbulent * (loss_slope + 2.0 * channel * area_slope * constants.per_channel_area_m2);
  const Scalar linear_slope = (constants.laminar * loss_slope - linear) * per_opening;
  const Scalar u_slope = -u * (quadratic_slope * magnitude(u) + linear_slope) * per_slope;
  return blended(
      open,
      EdgeFlowOf<Scalar>{.opening_m = opening,
                         .area_m2 = area,
                         .velocity_m_per_s = u,
                         .leakage_m3_per_s = leakage,
                         .flow_m3_per_s = area * u + leakage,
                         .conductance_m3_per_s_Pa = area * per_slope + leakage_conductance,
                         .flow_gain_m2_per_s = opening_slope * (area_slope * u + area * u_slope) + leakage_gain},
      closed);
}

}  // namespace spoolflow::rig
