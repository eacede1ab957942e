#pragma once
/// Force of the oil on the spool, one metering edge; closing > 0. Paper, equation (2), for each active edge:
///
///     F = rho Q^2 cos(e1)/(A1 sin e1) - rho Q^2 cos(e2)/(A2 sin e2) - rho l dQ/dt
///
/// with A1 the radial area the jet fills. The jet angle e1 follows von Mises' slot between opening and clearance, 21 to
/// 69 deg; the clearance that counts is widened by the boundary layer, d = gain sqrt(nu o/v), so cold oil bends the jet
/// towards the axis and closes harder. The lateral part rho Q v sin(e1) presses the spool to its bore by the share that
/// the notches do not balance.
#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

struct FlowForce {
  double jet_contraction = 0.75;
  double boundary_layer_gain = 4.0;
  double lateral_friction = 0.035;
  double friction_per_pressure_N_per_Pa = 1.7e-7;

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

}  // namespace spoolflow::rig
