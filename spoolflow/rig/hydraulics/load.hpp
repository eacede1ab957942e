#pragma once
/// What hangs between ports A and B.
///
/// held_difference  bench: both ports drain to the back pressure, the supply holds the difference over the open edge
/// held_path        bench: A and B are joined by a short hose, so both edges of the open path pass the same flow; the
///                  supply holds the difference from P to T over the whole path
/// held_return      bench: port A is fed instead of P, the supply holds the difference over the edge A to T; P, B and T
///                  are at the back pressure
/// orifice          a fixed turbulent orifice from port to port, with two line volumes
/// cylinder         a differential cylinder with mass, line volumes, leakage, friction and end cushions; B moves it
/// out:
///                  m dv_c/dt = p_B A_B - p_A A_A - d v_c - F_ext,  port volumes change with v_c
/// motor            a hydraulic motor that turns an inertia against a constant torque, such as a winch; B drives it:
///                  J dw/dt = D (p_B - p_A) - d w - M
///
/// With `return_to_tank` what comes back from the load goes straight to tank through a line of its own instead of
/// through port A: A then stays at tank pressure, and only the edge P to B meters. A sensor of one metering edge is
/// tested so; through port A the return flow also pulls on the spool, at the edge A to T, which a campaign of one edge
/// does not see. Made for x > 0.
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

enum class LoadKind { held_difference, orifice, cylinder, motor, held_path, held_return };

/// A bench whose supply holds a pressure difference over the valve itself.
inline bool holds_difference(LoadKind kind) {
  return kind == LoadKind::held_difference || kind == LoadKind::held_path || kind == LoadKind::held_return;
}

template <class Scalar>
struct LoadOf {
  LoadKind kind = LoadKind::held_difference;
  bool ideal_hold = false;      ///< the held difference follows its set value at once; not of held_return
  bool return_to_tank = false;  ///< of orifice, cylinder and motor
  Scalar port_volume_m3 = 5.0e-5;
  Scalar orifice_area_m2 = 1.2e-5;
  Scalar piston_area_B_m2 = 1.26e-3;
  Scalar piston_area_A_m2 = 1.26e-3;
  Scalar cylinder_stroke_m = 0.4;
  Scalar cylinder_mass_kg = 200.0;
  Scalar cylinder_drag_N_s_per_m = 2000.0;
  Scalar cylinder_leakage_m3_per_s_Pa = 2.0e-13;
  Scalar motor_displacement_m3_per_rad = 1.3e-5;
  Scalar motor_inertia_kg_m2 = 0.05;
  Scalar motor_torque_N_m = 35.0;
  Scalar motor_drag_N_m_s = 0.05;
  Scalar motor_leakage_m3_per_s_Pa = 1.0e-12;

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
    visit(Parameter{"motor_displacement_m3_per_rad", "m3/rad", 1e-7, 1e-3, "80 cm3 a turn"},
          self.motor_displacement_m3_per_rad);
    visit(Parameter{"motor_inertia_kg_m2", "kg m2", 1e-4, 100, "with what it turns"}, self.motor_inertia_kg_m2);
    visit(
        Parameter{"motor_torque_N_m", "N m", 0, 1e4, "against turning under flow from B; 27 bar at this displacement"},
        self.motor_torque_N_m);
    visit(Parameter{"motor_drag_N_m_s", "N m s", 0, 1e3, "bearings and gear, viscous part"}, self.motor_drag_N_m_s);
    visit(Parameter{"motor_leakage_m3_per_s_Pa", "m3/(s Pa)", 0, 1e-10, "past the pistons; 0.6 L/min at 100 bar"},
          self.motor_leakage_m3_per_s_Pa);
  }
};
using Load = LoadOf<double>;

}  // namespace spoolflow::rig
