#pragma once
/// What hangs between ports A and B.
///
/// held_difference  bench: both ports drain to the back pressure, the supply holds the difference over the open edge
/// orifice          a fixed turbulent orifice from port to port, with two line volumes
/// cylinder         a differential cylinder with mass, line volumes, leakage, friction and end cushions; B moves it
/// out:
///                  m dv_c/dt = p_B A_B - p_A A_A - d v_c - F_ext,  port volumes change with v_c
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

enum class LoadKind { held_difference, orifice, cylinder };

struct Load {
  LoadKind kind = LoadKind::held_difference;
  bool ideal_hold = false;  ///< the held difference follows its set value at once
  double port_volume_m3 = 5.0e-5;
  double orifice_area_m2 = 1.2e-5;
  double piston_area_B_m2 = 1.26e-3;
  double piston_area_A_m2 = 1.26e-3;
  double cylinder_stroke_m = 0.4;
  double cylinder_mass_kg = 200.0;
  double cylinder_drag_N_s_per_m = 2000.0;
  double cylinder_leakage_m3_per_s_Pa = 2.0e-13;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"port_volume_m3", "m3", 5e-6, 1e-2, "hose from valve to load, each"}, self.port_volume_m3);
    visit(Parameter{"orifice_area_m2", "m2", 1e-7, 1e-3, "discharge coefficient 0.7 is understood"},
          self.orifice_area_m2);
    visit(Parameter{"piston_area_B_m2", "m2", 1e-4, 5e-2, "40 mm piston"}, self.piston_area_B_m2);
    visit(Parameter{"piston_area_A_m2", "m2", 1e-4, 5e-2, "as B for a synchronous cylinder"}, self.piston_area_A_m2);
    visit(Parameter{"cylinder_stroke_m", "m", 0.01, 5, "piston starts mid-stroke"}, self.cylinder_stroke_m);
    visit(Parameter{"cylinder_mass_kg", "kg", 1, 50000, "moved with the piston"}, self.cylinder_mass_kg);
    visit(Parameter{"cylinder_drag_N_s_per_m", "N s/m", 0, 1e6, "guides and seals, viscous part"},
          self.cylinder_drag_N_s_per_m);
    visit(Parameter{"cylinder_leakage_m3_per_s_Pa", "m3/(s Pa)", 0, 1e-10, "past the piston; 0.12 L/min at 100 bar"},
          self.cylinder_leakage_m3_per_s_Pa);
  }
};

}  // namespace spoolflow::rig
