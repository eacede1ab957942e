#pragma once
/// One metering edge: notch geometry, overlap, clearance and wear; its flow by pressure difference.
///
///     o = s - overlap,  o+ = (o + sqrt(o^2 + c^2))/2          (opening, its smooth positive part; s the travel that
///     opens) A = n (w o+ + tan(theta) o+^2), no more than the notch's full depth allows dp = rho/2 (Q/(Cd A))^2 (1 +
///     Re_t/Re) + channel loss     (turbulent and laminar loss in series; Re = Q D_h/(A nu)) Q_leak = pi D c^3 (1 + 1.5
///     ecc^2)/(12 mu L) dp           (annular clearance over the overlap L left)
///
/// So the discharge coefficient is Cd sqrt(Re/(Re + Re_t)), smooth through zero flow and odd in dp.
#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

struct MeteringEdge {
  double overlap_m = 0.15e-3;
  double notches = 4.0;
  double notch_width_m = 1.2e-3;
  double notch_flank = 0.35;
  double discharge_coefficient = 0.68;
  double transition_reynolds = 60.0;
  double channel_area_m2 = 2.6e-5;
  double outlet_area_m2 = 1.2e-4;
  double outlet_angle_deg = 80.0;
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
    visit(Parameter{"channel_area_m2", "m2", 5e-6, 2e-3, "orifice area equivalent to the bores of the body in series"},
          self.channel_area_m2);
    visit(Parameter{"outlet_area_m2", "m2", 1e-5, 5e-3, "A2 of the paper's equation (2): chamber to port"},
          self.outlet_area_m2);
    visit(Parameter{"outlet_angle_deg", "deg", 45, 90, "e2 of the paper's equation (2), from the spool axis"},
          self.outlet_angle_deg);
    visit(Parameter{"damping_length_m", "m", -0.05, 0.05,
                    "l of the paper's equation (2); sign by flow direction in the chamber"},
          self.damping_length_m);
    visit(Parameter{"edge_radius_m", "m", 0, 1e-4, "ground edge 1 to 5 micrometres; worn edges tens of micrometres"},
          self.edge_radius_m);
    visit(Parameter{"clearance_eccentricity", "1", 0, 1, "spool in its bore, for leakage"},
          self.clearance_eccentricity);
  }
};

}  // namespace spoolflow::rig
