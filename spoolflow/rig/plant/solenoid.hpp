#pragma once
/// One proportional solenoid: winding, its heat, magnetic circuit, iron, hysteresis, eddy currents, armature friction.
///
///     dlambda/dt = u - R(T) i,   lambda = N Phi + N^2 P_leak i
///     dPhi/dt    = e             (from the magnetomotive balance over the eddy ladder)
///     F_mag      = (Phi/P_g)^2/2 dP_g/ds      = dW_co/ds at constant currents
///
/// Force, flux linkage and current are positive for current into the positive terminal; the force always pulls the
/// armature to its own pole.
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"
#include "spoolflow/rig/plant/friction.hpp"
#include "spoolflow/rig/plant/magnetic_circuit.hpp"
#include "spoolflow/rig/plant/magnetic_hysteresis.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

/// The solenoid's winding: turns, resistance over temperature, and the two faults a winding has.
///
///     R(T) = R20 (1 - s) (1 + alpha (T - 20 C)) + R_added
///
/// A shorted share s of the turns drops out of the winding and stays coupled to the flux as a closed secondary of s N
/// turns and s R20; referred to one turn, its conductance is s N^2 / R20 (the magnetic circuit sees it as an eddy
/// loop).
template <class Scalar>
struct CoilOf {
  Scalar turns = 700.0;
  Scalar resistance_20C_ohm = 2.7;
  Scalar temperature_coefficient_per_K = 3.93e-3;
  Scalar shorted_turns_fraction = 0.0;
  Scalar added_resistance_ohm = 0.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"turns", "1", 100, 4000,
                    "0.8 mm wire fills the 36 mm by 12 mm winding window of a 45 mm size-6 coil with about 700 turns"},
          self.turns);
    visit(Parameter{"resistance_20C_ohm", "ohm", 0.5, 40,
                    "77 m of 0.8 mm copper; data sheets of on-board-electronics size-6 valves state 2 to 3 ohm cold"},
          self.resistance_20C_ohm);
    visit(Parameter{"temperature_coefficient_per_K", "1/K", 3.5e-3, 4.5e-3, "copper at 20 C: 3.93e-3 (IEC 60028)"},
          self.temperature_coefficient_per_K);
    visit(Parameter{"shorted_turns_fraction", "1", 0, 0.5, "fault; 0 is a sound winding"}, self.shorted_turns_fraction);
    visit(Parameter{"added_resistance_ohm", "ohm", 0, 20, "fault: corroded plug or broken strand; 0 is sound"},
          self.added_resistance_ohm);
  }
};
using Coil = CoilOf<double>;

/// Turns that still carry the terminal current.
template <class Scalar>
inline Scalar active_turns(const CoilOf<Scalar>& coil) {
  return coil.turns * (1.0 - coil.shorted_turns_fraction);
}

/// Resistance between the terminals [ohm] at the winding's temperature.
template <class Scalar>
inline Scalar resistance_ohm(const CoilOf<Scalar>& coil, Scalar temperature_C) {
  return coil.resistance_20C_ohm * (1.0 - coil.shorted_turns_fraction) *
             (1.0 + coil.temperature_coefficient_per_K * (temperature_C - 20.0)) +
         coil.added_resistance_ohm;
}

/// One-turn conductance [1/ohm] of the shorted turns at the winding's temperature; 0 without the fault.
template <class Scalar>
inline Scalar shorted_turns_conductance_S(const CoilOf<Scalar>& coil, Scalar temperature_C) {
  return coil.shorted_turns_fraction * coil.turns * coil.turns /
         (coil.resistance_20C_ohm * (1.0 + coil.temperature_coefficient_per_K * (temperature_C - 20.0)));
}

/// Self-heating of a solenoid: two thermal masses, winding and housing.
///
///     C_w dT_w/dt = R i^2 - G_wh (T_w - T_h)
///     C_h dT_h/dt = P_iron + G_wh (T_w - T_h) - G_ha (T_h - T_ambient) - G_ho (T_h - T_oil)
///
/// Time constants are minutes, so the plant integrates it once a step, exactly enough by the explicit midpoint rule.
/// Leaves out the temperature field inside the winding.
template <class Scalar>
struct CoilHeatOf {
  Scalar winding_heat_capacity_J_per_K = 130.0;
  Scalar housing_heat_capacity_J_per_K = 350.0;
  Scalar winding_to_housing_W_per_K = 1.2;
  Scalar housing_to_ambient_W_per_K = 0.35;
  Scalar housing_to_oil_W_per_K = 0.4;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"winding_heat_capacity_J_per_K", "J/K", 10, 2000, "0.33 kg of copper at 385 J/(kg K)"},
          self.winding_heat_capacity_J_per_K);
    visit(Parameter{"housing_heat_capacity_J_per_K", "J/K", 30, 10000, "0.75 kg of steel at 465 J/(kg K)"},
          self.housing_heat_capacity_J_per_K);
    visit(Parameter{"winding_to_housing_W_per_K", "W/K", 0.05, 20, "winding some 20 K above the housing at 25 W"},
          self.winding_to_housing_W_per_K);
    visit(
        Parameter{"housing_to_ambient_W_per_K", "W/K", 0.02, 10, "0.03 m2 of surface in still air, 10 to 12 W/(m2 K)"},
        self.housing_to_ambient_W_per_K);
    visit(Parameter{"housing_to_oil_W_per_K", "W/K", 0, 20, "wet armature tube screwed into the valve body"},
          self.housing_to_oil_W_per_K);
  }
};

template <class Scalar>
struct CoilHeatStateOf {
  Scalar winding_temperature_C = 25.0;
  Scalar housing_temperature_C = 25.0;
};

/// Advances both temperatures with the losses held; explicit midpoint.
template <class Scalar>
inline void heat_up(const CoilHeatOf<Scalar>& heat, CoilHeatStateOf<Scalar>& state, Scalar winding_loss_W,
                    Scalar iron_loss_W, Scalar ambient_C, Scalar oil_C, Scalar dt_s) {
  const auto rates = [&](const CoilHeatStateOf<Scalar>& at) {
    const Scalar exchange_W = heat.winding_to_housing_W_per_K * (at.winding_temperature_C - at.housing_temperature_C);
    return CoilHeatStateOf<Scalar>{
        (winding_loss_W - exchange_W) / heat.winding_heat_capacity_J_per_K,
        (iron_loss_W + exchange_W - heat.housing_to_ambient_W_per_K * (at.housing_temperature_C - ambient_C) -
         heat.housing_to_oil_W_per_K * (at.housing_temperature_C - oil_C)) /
            heat.housing_heat_capacity_J_per_K};
  };
  const CoilHeatStateOf<Scalar> first = rates(state);
  const CoilHeatStateOf<Scalar> second =
      rates({state.winding_temperature_C + 0.5 * dt_s * first.winding_temperature_C,
             state.housing_temperature_C + 0.5 * dt_s * first.housing_temperature_C});
  state.winding_temperature_C += dt_s * second.winding_temperature_C;
  state.housing_temperature_C += dt_s * second.housing_temperature_C;
}

/// Eddy currents of the solid iron as a Cauer ladder of two shorted one-turn windings round the main flux.
///
///     e = dPhi/dt = r_1 j + r_2 (j - j_2),    l_2 dj_2/dt = r_2 (j - j_2)
///
/// j opposes the winding's magnetomotive force. Slow changes see r_1 alone (eddy currents through the whole depth);
/// fast ones see r_1 + r_2 (the skin), which is how a solid core behaves. Its two time constants are P/r_1 with the
/// permeance P of the magnetic circuit, about 5 ms here, and l_2/r_2.
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

template <class Scalar>
struct SolenoidOf {
  CoilOf<Scalar> coil;
  CoilHeatOf<Scalar> heat;
  MagneticCircuitOf<Scalar> circuit;
  MagneticMaterialOf<Scalar> iron;
  MagneticHysteresisOf<Scalar> hysteresis;
  EddyCurrentsOf<Scalar> eddy;
  FrictionOf<Scalar> friction{.base_N = 0.3,
                              .stiction_ratio = 1.2,
                              .ageing_gain = 0.2,
                              .ageing_time_s = 10.0,
                              .ageing_distance_m = 3e-5,
                              .contact_stiffness_N_per_m = 1.0e6,
                              .viscosity_exponent = 0.0};
  Scalar side_friction_coefficient = 0.06;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("coil", self.coil);
    visit("heat", self.heat);
    visit("circuit", self.circuit);
    visit("iron", self.iron);
    visit("hysteresis", self.hysteresis);
    visit("eddy", self.eddy);
    visit("friction", self.friction);
    visit(Parameter{"side_friction_coefficient", "1", 0, 0.4, "armature on PTFE film 0.05 to 0.1, on brass 0.15"},
          self.side_friction_coefficient);
  }
};
using Solenoid = SolenoidOf<double>;

template <class Scalar>
struct SolenoidStateOf {
  Scalar flux_linkage_Wb = 0.0;  ///< of the winding
  Scalar flux_Wb = 0.0;          ///< through iron and working gap
  Scalar skin_current_A = 0.0;   ///< j_2 of the eddy ladder
  IronMemoryOf<Scalar> iron;
  CoilHeatStateOf<Scalar> heat;
  FrictionStateOf<Scalar> friction;
};
using SolenoidState = SolenoidStateOf<double>;

/// Current through the winding's terminals [A]: what the leakage inductance carries beyond the main flux.
inline double winding_current_A(const Solenoid& solenoid, const SolenoidState& state) {
  const double turns = active_turns(solenoid.coil);
  return (state.flux_linkage_Wb - turns * state.flux_Wb) / (turns * turns * solenoid.circuit.leakage_permeance_H);
}

}  // namespace spoolflow::rig
