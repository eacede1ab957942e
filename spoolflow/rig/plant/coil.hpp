#pragma once
/// The solenoid's winding: turns, resistance over temperature, and the two faults a winding has.
///
///     R(T) = R20 (1 - s) (1 + alpha (T - 20 C)) + R_added
///
/// A shorted share s of the turns drops out of the winding and stays coupled to the flux as a closed secondary of s N
/// turns and s R20; referred to one turn, its conductance is s N^2 / R20 (the magnetic circuit sees it as an eddy
/// loop).
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

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

}  // namespace spoolflow::rig
