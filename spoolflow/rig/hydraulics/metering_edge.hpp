#pragma once
/// One metering edge: notch geometry, overlap, clearance and wear; its flow by pressure difference.
///
///     o = s - overlap                                   (s the travel that opens)
///     o+ = 0 below -c', (o + c')^2/(4 c') around 0, o above c';   c' = c + r, clearance and edge radius
///     A = n (w o+ + tan(theta) o+^2)
///     dp = rho/2 (Q_n/(Cd A))^2 (1 + Re_t/Re) + rho/2 (Q_n/A_channel)^2,   Re = 2 o+ Q_n/(A nu)
///     Q_leak = pi D c^3 (1 + 1.5 ecc^2)/(12 rho nu L) dp,  L = L_s + max(0, -o)
///
/// Turbulent and laminar loss in series make the discharge coefficient Cd sqrt(Re/(Re + Re_t)): smooth through zero
/// flow and odd in dp. A worn (rounded) edge opens earlier and contracts the jet less: Cd -> Cd + (0.95 - Cd) r/(r +
/// o+). Leaves out the end of the notches and choking by cavitation.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "spoolflow/rig/numerics/parameter.hpp"

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
  }
};

/// What does not change within a step: the edge in its oil.
struct EdgeConstants {
  double clearance_m;          ///< c' of the opening
  double turbulent;            ///< rho/2: dp = turbulent (1/Cd^2 + (A/A_channel)^2) u^2 ...
  double laminar;              ///< ... + laminar/(Cd^2 o+) u, with u = Q_n/A
  double leakage;              ///< Q_leak L/dp [m4/(s Pa)]
  double outlet_per_m2;        ///< cot(e2)/A2
  double per_channel_area_m2;  ///< 1/A_channel
  double chamber_area_m2;      ///< ring between spool neck and bore, half the bore's cross-section
};

inline EdgeConstants edge_constants(const MeteringEdge& edge, double bore_diameter_m, double clearance_m,
                                    double density_kg_per_m3, double viscosity_m2_per_s) {
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
  const double per_length = 1.0 / (edge.sealing_length_m + std::max(0.0, -o));
  const double leakage_conductance = constants.leakage * per_length;
  const double leakage = leakage_conductance * pressure_difference_Pa;
  const double leakage_gain = o < 0.0 ? leakage * per_length : 0.0;
  const double c = constants.clearance_m;
  if (o <= -c) return {0.0, 0.0, 0.0, leakage, leakage, leakage_conductance, leakage_gain};

  double opening = o;
  double opening_slope = 1.0;
  if (o < c) {
    opening_slope = (o + c) / (2.0 * c);
    opening = c * opening_slope * opening_slope;
  }
  const double width = edge.notches * (edge.notch_width_m + edge.notch_flank * opening);
  const double area = opening * width;
  const double area_slope = width + edge.notches * edge.notch_flank * opening;

  const double per_rounded = 1.0 / (edge.edge_radius_m + opening);
  const double rounding = (0.95 - edge.discharge_coefficient) * edge.edge_radius_m * per_rounded;
  const double per_discharge = 1.0 / (edge.discharge_coefficient + rounding);
  const double loss = per_discharge * per_discharge;
  const double loss_slope = 2.0 * loss * per_discharge * rounding * per_rounded;
  const double channel = area * constants.per_channel_area_m2;

  const double per_opening = 1.0 / opening;
  const double quadratic = constants.turbulent * (loss + channel * channel);
  const double linear = constants.laminar * loss * per_opening;
  const double slope = std::sqrt(linear * linear + 4.0 * quadratic * std::abs(pressure_difference_Pa));
  const double per_slope = 1.0 / slope;
  const double u = 2.0 * pressure_difference_Pa / (linear + slope);
  const double quadratic_slope =
      constants.turbulent * (loss_slope + 2.0 * channel * area_slope * constants.per_channel_area_m2);
  const double linear_slope = (constants.laminar * loss_slope - linear) * per_opening;
  const double u_slope = -u * (quadratic_slope * std::abs(u) + linear_slope) * per_slope;
  return {.opening_m = opening,
          .area_m2 = area,
          .velocity_m_per_s = u,
          .leakage_m3_per_s = leakage,
          .flow_m3_per_s = area * u + leakage,
          .conductance_m3_per_s_Pa = area * per_slope + leakage_conductance,
          .flow_gain_m2_per_s = opening_slope * (area_slope * u + area * u_slope) + leakage_gain};
}

}  // namespace spoolflow::rig
