#pragma once
/// What the plant remembers beyond its differential states: iron hysteresis, friction elements, contact ages, heat of
/// the losses. Within a step they are functions of how far flux and body have moved since its start; at its end they
/// are committed.
#include "spoolflow/rig/plant/plant_dynamics.hpp"

namespace spoolflow::rig {

/// Losses of a solenoid summed over the internal steps [J].
struct SolenoidLosses {
  double winding_J = 0.0;
  double iron_J = 0.0;
};

struct PlantLosses {
  SolenoidLosses solenoid_a, solenoid_b;
};

/// `iron_J_per_m3` is the work done on the iron; what of it is stored comes back within a cycle, some millijoules that
/// move no temperature.
inline void add_losses(const Solenoid& solenoid, const SolenoidConstants& constants, const SolenoidState& state,
                       const SolenoidRates& rates, double iron_J_per_m3, double h, SolenoidLosses& losses) {
  const double skin = rates.eddy_current_A - state.skin_current_A;
  losses.winding_J += h * constants.resistance_ohm * rates.current_A * rates.current_A;
  losses.iron_J += h * (solenoid.eddy.core_resistance_ohm * rates.eddy_current_A * rates.eddy_current_A +
                        solenoid.eddy.skin_resistance_ohm * skin * skin) +
                   constants.iron_length_m / constants.per_iron_area_m2 * iron_J_per_m3;
}

inline void commit(SolenoidState& state, SolenoidVector states) {
  state.flux_linkage_Wb = states[state_linkage];
  state.flux_Wb = states[state_flux];
  state.skin_current_A = states[state_skin];
}

inline void commit(PlantState& state, HydraulicVector states) {
  state.pressure_P_Pa = std::max(states[state_p_P], cavitation_pressure_Pa);
  state.pressure_A_Pa = std::max(states[state_p_A], cavitation_pressure_Pa);
  state.pressure_B_Pa = std::max(states[state_p_B], cavitation_pressure_Pa);
  state.hold_flow_m3_per_s = states[state_Q_i];
  state.cylinder_position_m = states[state_x_c];
  state.cylinder_velocity_m_per_s = states[state_v_c];
}

/// Contact ages at states reached `elapsed_s` after the state; `first` are the rates at the state.
inline ContactAges contact_ages(const PlantConstants& c, const PlantState& state, const PlantRates& first,
                                const PlantVector& reached, double elapsed_s) {
  const double displacement = reached[state_x] - state.position_m;
  const auto age_of = [&](const FrictionConstants& friction, const FrictionState& memory, double breakaway_N) {
    return aged(friction, memory.age, slip_m(friction, memory, displacement, breakaway_N), elapsed_s);
  };
  ContactAges ages{};
  if (c.hydraulics) ages.spool = age_of(c.spool_friction, state.spool_friction, first.spool_breakaway_N);
  if (c.solenoid_a) {
    ages.armature_a = age_of(c.armature_a_friction, state.solenoid_a.friction, first.armature_a_breakaway_N);
  }
  if (c.solenoid_b) {
    ages.armature_b = age_of(c.armature_b_friction, state.solenoid_b.friction, first.armature_b_breakaway_N);
  }
  return ages;
}

inline ContactAges contact_ages(const PlantState& state) {
  return {state.spool_friction.age, state.solenoid_a.friction.age, state.solenoid_b.friction.age};
}

/// Moves the state to `reached` after a time h: `first` and `last` are the rates at the step's start and end.
inline void commit(const PlantParameters& p, const PlantConstants& c, PlantState& state, const PlantVector& reached,
                   const PlantRates& first, const PlantRates& last, const ContactAges& ages, double h,
                   PlantLosses& losses) {
  const double displacement = reached[state_x] - state.position_m;
  const auto commit_flux = [&](const Solenoid& solenoid, const SolenoidConstants& constants, SolenoidState& memory,
                               SolenoidVector states, const SolenoidRates& rates, SolenoidLosses& loss) {
    const double iron_J_per_m3 =
        magnetise(constants.iron, memory.iron, states[state_flux] * constants.per_iron_area_m2);
    add_losses(solenoid, constants, memory, rates, iron_J_per_m3, h, loss);
    commit(memory, states);
  };
  if (c.magnetic_a) {
    commit_flux(p.solenoid_a, c.solenoid_a_constants, state.solenoid_a, solenoid_a_of(reached), first.solenoid_a,
                losses.solenoid_a);
  }
  if (c.magnetic_b) {
    commit_flux(p.solenoid_b, c.solenoid_b_constants, state.solenoid_b, solenoid_b_of(reached), first.solenoid_b,
                losses.solenoid_b);
  }
  if (c.solenoid_a) {
    slide(c.armature_a_friction, state.solenoid_a.friction, displacement, last.armature_a_breakaway_N);
    state.solenoid_a.friction.age = ages.armature_a;
  }
  if (c.solenoid_b) {
    slide(c.armature_b_friction, state.solenoid_b.friction, displacement, last.armature_b_breakaway_N);
    state.solenoid_b.friction.age = ages.armature_b;
  }
  if (c.hydraulics) {
    slide(c.spool_friction, state.spool_friction, displacement, last.spool_breakaway_N);
    state.spool_friction.age = ages.spool;
    commit(state, hydraulics_of(reached));
  }
  state.position_m = reached[state_x];
  state.velocity_m_per_s = reached[state_v];
  state.time_s += h;
}

}  // namespace spoolflow::rig
