#pragma once
/// Eddy currents of the solid iron as a Cauer ladder of two shorted one-turn windings round the main flux.
///
///     e = dPhi/dt = r_1 j + r_2 (j - j_2),    l_2 dj_2/dt = r_2 (j - j_2)
///
/// j opposes the winding's magnetomotive force. Slow changes see r_1 alone (eddy currents through the whole depth);
/// fast ones see r_1 + r_2 (the skin), which is how a solid core behaves. Its two time constants are P/r_1 with the
/// permeance P of the magnetic circuit, about 5 ms here, and l_2/r_2.
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct EddyCurrentsOf {
  Scalar core_resistance_ohm = 1.0e-4;
  Scalar skin_resistance_ohm = 2.0e-4;
  Scalar skin_inductance_H = 1.5e-7;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"core_resistance_ohm", "ohm", 1e-5, 1e-1,
                    "one turn; solid armature of 18 mm, 30 mm long, at 2e-7 ohm m: 8 pi rho/length = 1.7e-4"},
          self.core_resistance_ohm);
    visit(Parameter{"skin_resistance_ohm", "ohm", 1e-5, 1e-1, "one turn; adds to the core's when the skin carries it"},
          self.skin_resistance_ohm);
    visit(Parameter{"skin_inductance_H", "H", 1e-9, 1e-5, "with the skin resistance a second time constant near 1 ms"},
          self.skin_inductance_H);
  }
};
using EddyCurrents = EddyCurrentsOf<double>;

}  // namespace spoolflow::rig
