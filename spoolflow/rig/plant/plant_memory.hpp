#pragma once
/// What the plant remembers beyond its differential states: iron hysteresis, friction elements, contact ages, heat of
/// the losses. Within a step they are functions of how far flux and body have moved since its start; at its end they
/// are committed.
#include "spoolflow/rig/plant/plant_dynamics.hpp"

namespace spoolflow::rig {

/// Losses of a solenoid summed over the internal steps [J].
template <class Scalar>
struct SolenoidLossesOf {
  Scalar winding_J = 0.0;
  Scalar iron_J = 0.0;
};

template <class Scalar>
struct PlantLossesOf {
  SolenoidLossesOf<Scalar> solenoid_a, solenoid_b;
};
using PlantLosses = PlantLossesOf<double>;

/// `iron_J_per_m3` is the work done on the iron; what of it is stored comes back within a cycle, some millijoules that
/// move no temperature.
template <class Scalar>
inline void add_losses(const SolenoidOf<Scalar>& solenoid, const SolenoidConstantsOf<Scalar>& constants,
                       const SolenoidStateOf<Scalar>& state, const SolenoidRatesOf<Scalar>& rates, Scalar iron_J_per_m3,
                       Scalar h, SolenoidLossesOf<Scalar>& losses) {
  const Scalar skin = rates.eddy_current_A - state.skin_current_A;
  losses.winding_J += h * constants.resistance_ohm * rates.current_A * rates.current_A;
  losses.iron_J += h * (solenoid.eddy.core_resistance_ohm * rates.eddy_current_A * rates.eddy_current_A +
                        solenoid.eddy.skin_resistance_ohm * skin * skin) +
                   constants.iron_length_m / constants.per_iron_area_m2 * iron_J_per_m3;
}

/// What a step's losses make of both solenoids' temperatures.
template <class Scalar>
inline void heat_up(const PlantParametersOf<Scalar>& p, const PlantConstantsOf<Scalar>& c, PlantStateOf<Scalar>& state,
                    const PlantLossesOf<Scalar>& losses, const PlantInputOf<Scalar>& input, Given<Scalar> dt_s) {
  const auto heat = [&](const SolenoidOf<Scalar>& solenoid, SolenoidStateOf<Scalar>& its,
                        const SolenoidLossesOf<Scalar>& loss) {
    heat_up(solenoid.heat, its.heat, loss.winding_J / dt_s, loss.iron_J / dt_s, input.ambient_temperature_C,
            input.oil_temperature_C, dt_s);
  };
  if (c.solenoid_a) heat(p.solenoid_a, state.solenoid_a, losses.solenoid_a);
  if (c.solenoid_b) heat(p.solenoid_b, state.solenoid_b, losses.solenoid_b);
}

/// Contact ages at states reached `elapsed_s` after the state; `first` are the rates at the state.
template <class Scalar>
inline ContactAgesOf<Scalar> contact_ages(const PlantConstantsOf<Scalar>& c, const PlantStateOf<Scalar>& state,
                                          const PlantRatesOf<Scalar>& first, const PlantVectorOf<Scalar>& reached,
                                          Given<Scalar> elapsed_s) {
  const Scalar displacement = reached[state_x] - state.position_m;
  const auto age_of = [&](const FrictionConstantsOf<Scalar>& friction, const FrictionStateOf<Scalar>& memory,
                          Scalar breakaway_N) {
    return aged(friction, memory.age, slip_m(friction, memory, displacement, breakaway_N), Scalar(elapsed_s));
  };
  ContactAgesOf<Scalar> ages{};
  if (c.hydraulics) ages.spool = age_of(c.spool_friction, state.spool_friction, first.spool_breakaway_N);
  if (c.solenoid_a) {
    ages.armature_a = age_of(c.armature_a_friction, state.solenoid_a.friction, first.armature_a_breakaway_N);
  }
  if (c.solenoid_b) {
    ages.armature_b = age_of(c.armature_b_friction, state.solenoid_b.friction, first.armature_b_breakaway_N);
  }
  return ages;
}

template <class Scalar>
inline ContactAgesOf<Scalar> contact_ages(const PlantStateOf<Scalar>& state) {
  return {state.spool_friction.age, state.solenoid_a.friction.age, state.solenoid_b.friction.age};
}

/// Moves the state to `reached` after a time h: `first` and `last` are the rates at the step's start and end. Of
/// several valves, those that take it.
template <class Scalar>
inline void commit(const PlantParametersOf<Scalar>& p, const PlantConstantsOf<Scalar>& c, PlantStateOf<Scalar>& state,
                   const PlantVectorOf<Scalar>& reached, const PlantRatesOf<Scalar>& first,
                   const PlantRatesOf<Scalar>& last, const ContactAgesOf<Scalar>& ages, Given<Scalar> h,
                   PlantLossesOf<Scalar>& losses, const Given<Mask<Scalar>>& taken = true) {
  const Scalar displacement = reached[state_x] - state.position_m;
  const auto commit_flux = [&](const SolenoidOf<Scalar>& solenoid, const SolenoidConstantsOf<Scalar>& constants,
                               SolenoidStateOf<Scalar>& memory, SolenoidVectorOf<Scalar> states,
                               const SolenoidRatesOf<Scalar>& rates, SolenoidLossesOf<Scalar>& loss) {
    const Scalar iron_J_per_m3 =
        magnetise(constants.iron, memory.iron, states[state_flux] * constants.per_iron_area_m2, taken);
    SolenoidLossesOf<Scalar> sum = loss;
    add_losses(solenoid, constants, memory, rates, iron_J_per_m3, Scalar(h), sum);
    take(taken, loss, sum);
    take(taken, memory.flux_linkage_Wb, states[state_linkage]);
    take(taken, memory.flux_Wb, states[state_flux]);
    take(taken, memory.skin_current_A, states[state_skin]);
  };
  const auto commit_contact = [&](const FrictionConstantsOf<Scalar>& friction, FrictionStateOf<Scalar>& memory,
                                  Scalar breakaway_N, Scalar age) {
    FrictionStateOf<Scalar> moved = memory;
    slide(friction, moved, displacement, breakaway_N);
    moved.age = age;
    take(taken, memory, moved);
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
    commit_contact(c.armature_a_friction, state.solenoid_a.friction, last.armature_a_breakaway_N, ages.armature_a);
  }
  if (c.solenoid_b) {
    commit_contact(c.armature_b_friction, state.solenoid_b.friction, last.armature_b_breakaway_N, ages.armature_b);
  }
  if (c.hydraulics) {
    commit_contact(c.spool_friction, state.spool_friction, last.spool_breakaway_N, ages.spool);
    const HydraulicVectorOf<Scalar> states = hydraulics_of(reached);
    take(taken, state.pressure_P_Pa, larger(states[state_p_P], Scalar(cavitation_pressure_Pa)));
    take(taken, state.pressure_A_Pa, larger(states[state_p_A], Scalar(cavitation_pressure_Pa)));
    take(taken, state.pressure_B_Pa, larger(states[state_p_B], Scalar(cavitation_pressure_Pa)));
    take(taken, state.hold_flow_m3_per_s, states[state_Q_i]);
    take(taken, state.cylinder_position_m, states[state_x_c]);
    take(taken, state.cylinder_velocity_m_per_s, states[state_v_c]);
  }
  take(taken, state.position_m, reached[state_x]);
  take(taken, state.velocity_m_per_s, reached[state_v]);
  take(taken, state.time_s, state.time_s + h);
}

}  // namespace spoolflow::rig
