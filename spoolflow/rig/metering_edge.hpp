#pragma once
/// One metering edge: notch geometry, overlap, clearance and wear; its flow by pressure difference.
///
///     o = s - overlap                                   (s the travel that opens)
///     o+ = 0 below -c', (o + c')^2/(4 c') around 0, o above c';   c' = c + r, clearance and edge radius
///     A = n (w o+ + tan(theta) o+^2)
///     dp = rho/2 (Q_n/(Cd A))^2 (1 + Re_t/Re) + rho/2 (Q_n/A_channel)^2,   Re = 2 o+ Q_n/(A nu)
///     Q_leak = pi D c^3 (1 + 1.5 ecc^2)/(12 rho nu L) dp,  L = L_s + (sqrt(o^2 + L_s^2) - o)/2
///
/// Turbulent and laminar loss in series make the discharge coefficient Cd sqrt(Re/(Re + Re_t)): smooth through zero
/// flow and odd in dp. A worn (rounded) edge opens earlier and contracts the jet less: Cd -> Cd + (0.95 - Cd) r/(r +
/// o+). Leaves out the end of the notches and choking by cavitation.
#include <cmath>
#include <numbers>

#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

struct MeteringEdge {
  double overlap_m = 0.15e-3;
  double notches = 4.0;
  double notch_width_m = 1.08e-3;
  double notch_flank = 0.31;
  double discharge_coefficient = 0.68;
  double transition_reynolds = 60.0;
  double sealing_length_m = 0.2e-3;
  double channel_area_m2 = 2.6e-5;
  double outlet_area_m2 = 1.2e-4;
  double outlet_cotangent = 0.18;
  double damping_length_m = 12.0e-3;
  double edge_radius_m = 2.0e-6;
  double clearance_eccentricity = 0.5;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"overlap_m", "m", 2e-5, 1e-3, "positive overlap of proportional valves: 5 to 20 % of the stroke"},
          self.overlap_m);
    visit(Parameter{"notches", "1", 1, 16, "on the land's circumference"}, self.notches);
    visit(Parameter{"notch_width_m", "m", 1e-4, 1e-2, "each, at its tip"}, self.notch_width_m);
    visit(Parameter{"notch_flank", "1", 0, 3, "tangent of the notch's flank: both widen it by 2 tan per opening"},
          self.notch_flank);
    visit(Parameter{"discharge_coefficient", "1", 0.5, 0.95, "sharp edge, turbulent: 0.6 to 0.75"},
          self.discharge_coefficient);
    visit(Parameter{"transition_reynolds", "1", 0, 500,
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
    visit(Parameter{"damping_length_m", "m", -0.05, 0.05,
                    "l of the paper's equation (2); sign by flow direction in the chamber"},
          self.damping_length_m);
    visit(Parameter{"edge_radius_m", "m", 0, 1e-4, "ground edge 1 to 5 micrometres; worn edges tens of micrometres"},
          self.edge_radius_m);
    visit(Parameter{"clearance_eccentricity", "1", 0, 1, "spool in its bore, for leakage"},
          self.clearance_eccentricity);
  }
};

/// What does not change within a step: the edge in its oil.
struct EdgeConstants {
  double clearance_m;  ///< c' of the smooth opening
  double turbulent;    ///< rho/2, dp = turbulent (1/Cd^2 + (A/A_channel)^2) u^2 ...
  double laminar;      ///< ... + laminar/(Cd^2 o+) u, with u = Q_n/A
  double leakage;      ///< Q_leak L/dp [m4/(s Pa)]
  double outlet;       ///< cot(e2)/A2 [1/m2]
};

inline EdgeConstants edge_constants(const MeteringEdge& edge, double bore_diameter_m, double clearance_m,
                                    double density_kg_per_m3, double viscosity_m2_per_s) {
  return {.clearance_m = clearance_m + edge.edge_radius_m,
          .turbulent = 0.5 * density_kg_per_m3,
          .laminar = 0.25 * density_kg_per_m3 * viscosity_m2_per_s * edge.transition_reynolds,
          .leakage = std::numbers::pi * bore_diameter_m * clearance_m * clearance_m * clearance_m *
                     (1.0 + 1.5 * edge.clearance_eccentricity * edge.clearance_eccentricity) /
                     (12.0 * density_kg_per_m3 * viscosity_m2_per_s),
          .outlet = edge.outlet_cotangent / edge.outlet_area_m2};
}

/// Flow through one edge and its slopes.
struct EdgeFlow {
  double opening_m;         ///< o+
  double area_m2;           ///< A
  double velocity_m_per_s;  ///< u = Q_n/A, with the sign of dp
  double leakage_m3_per_s;
  double flow_m3_per_s;            ///< Q_n + Q_leak
  double conductance_m3_per_s_Pa;  ///< dQ/d(dp) > 0
  double flow_gain_m2_per_s;       ///< dQ/ds
};

inline EdgeFlow edge_flow(const MeteringEdge& edge, const EdgeConstants& constants, double travel_m,
                          double pressure_difference_Pa) {
  const double o = travel_m - edge.overlap_m;
  const double seal_root = std::sqrt(o * o + edge.sealing_length_m * edge.sealing_length_m);
  const double length = edge.sealing_length_m + 0.5 * (seal_root - o);
  const double leakage_conductance = constants.leakage / length;
  const double leakage = leakage_conductance * pressure_difference_Pa;
  const double leakage_gain = 0.5 * leakage * (1.0 - o / seal_root) / length;
  const double c = constants.clearance_m;
  if (o <= -c) return {0.0, 0.0, 0.0, leakage, leakage, leakage_conductance, leakage_gain};

  const double around = (o + c) / (2.0 * c);
  const double opening = o < c ? c * around * around : o;
  const double opening_slope = o < c ? around : 1.0;
  const double area = edge.notches * opening * (edge.notch_width_m + edge.notch_flank * opening);
  const double area_slope = edge.notches * (edge.notch_width_m + 2.0 * edge.notch_flank * opening);

  const double rounding = edge.edge_radius_m / (edge.edge_radius_m + opening);
  const double discharge = edge.discharge_coefficient + (0.95 - edge.discharge_coefficient) * rounding;
  const double discharge_slope = -(0.95 - edge.discharge_coefficient) * rounding / (edge.edge_radius_m + opening);
  const double loss = 1.0 / (discharge * discharge);
  const double loss_slope = -2.0 * loss * discharge_slope / discharge;
  const double channel = area / edge.channel_area_m2;

  const double quadratic = constants.turbulent * (loss + channel * channel);
  const double linear = constants.laminar * loss / opening;
  const double slope = std::sqrt(linear * linear + 4.0 * quadratic * std::abs(pressure_difference_Pa));
  const double u = 2.0 * pressure_difference_Pa / (linear + slope);
  const double quadratic_slope = constants.turbulent * (loss_slope + 2.0 * channel * area_slope / edge.channel_area_m2);
  const double linear_slope = constants.laminar * (loss_slope - loss / opening) / opening;
  const double u_slope = -u * (quadratic_slope * std::abs(u) + linear_slope) / slope;
  return {.opening_m = opening,
          .area_m2 = area,
          .velocity_m_per_s = u,
          .leakage_m3_per_s = leakage,
          .flow_m3_per_s = area * u + leakage,
          .conductance_m3_per_s_Pa = area / slope + leakage_conductance,
          .flow_gain_m2_per_s = opening_slope * (area_slope * u + area * u_slope) + leakage_gain};
}

}  // namespace spoolflow::rig
