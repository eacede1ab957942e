#pragma once
/// The solenoid as a force sensor: coil current and spool position give the magnetic force. The coil voltage serves the
/// coil's diagnosis and does not enter the force.
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/due.hpp"
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/coil_resistance.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::sensor {

/// Everything about one solenoid that its force needs.
template <class T>
struct ActuatorParameters {
  MagneticForce<T> magnetic_force;  ///< over magnetising current [A] and position [m]
  Coil<T> coil;
  CoilResistance<T> coil_resistance;
  Map<T, force_map_currents, force_map_positions> friction_N;  ///< armature friction while sliding, >= 0
  T coercive_current_A{};                                      ///< half width of the widest loop
  T per_wiping_flux{};        ///< 1 / the flux swing [Wb] after which older history does not matter
  T force_uncertainty_N{};    ///< one standard deviation of the force at a known magnetising current
  T current_uncertainty_A{};  ///< one standard deviation of the magnetising current at rest
  T eddy_uncertainty{};       ///< its growth per eddy current [A/A]
};

/// What the solenoid remembers between samples; {} is a demagnetised coil before its first sample.
template <class T>
struct ActuatorState {
  CoilState<T> coil{};
  CoilResistanceState<T> coil_resistance{};
  T lowest_flux_Wb{};  ///< since the first sample
  T highest_flux_Wb{};
  T uncertainty_N{};          ///< of the magnetic force and ...
  T friction_half_width_N{};  ///< ... the armature's friction, as they were when they were last computed
};

/// What the solenoid answers.
template <class T>
struct ActuatorEstimate {
  T magnetic_force_N{};           ///< opening > 0, without armature friction
  T uncertainty_N{};              ///< one standard deviation of the magnetic force
  T friction_half_width_N{};      ///< armature friction while it slides, >= 0; its sign is that of the velocity
  T force_per_current_N_per_A{};  ///< what an error of the current means for the force
  T force_per_position_N_per_m{};
  bool inside_map = true;  ///< current and position lie within what was calibrated; `follow_force` tells it otherwise
};

static_assert(std::is_trivially_copyable_v<ActuatorParameters<float>>);
static_assert(std::is_trivially_copyable_v<ActuatorState<float>>);

/// Saturation may take so much of what the force rises by above the largest current of its map: one standard deviation.
inline constexpr double saturation_share = 0.5;

/// Keeps the flux linkage's range since the first sample.
template <class T>
constexpr void widen_flux_range(ActuatorState<T>& state) {
  const T flux_Wb = state.coil.hysteresis.flux;
  state.lowest_flux_Wb = smaller(state.lowest_flux_Wb, flux_Wb);
  state.highest_flux_Wb = larger(state.highest_flux_Wb, flux_Wb);
}

/// What the unknown history before the first sample may still mean for the current [A], one standard deviation: a swing
/// of twice the largest threshold wipes it out.
template <class T>
constexpr T unknown_memory_A(const ActuatorParameters<T>& actuator, const ActuatorState<T>& state) {
  const T left = T(1) - (state.highest_flux_Wb - state.lowest_flux_Wb) * actuator.per_wiping_flux;
  return at_least_zero(left) * actuator.coercive_current_A;
}

/// Diagnosis of the coil by its voltage, from the same sample as the step before it; a NaN or a coil whose resistance
/// was never calibrated says nothing. Every sample counts in the mean; the rest runs where it is `due`, at least
/// `due.since_s()` after the last time.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_coil(const ActuatorParameters<T>& actuator, ActuatorState<T>& state,
                                            const Sample<T>& sample, T largest_current_A, const Due<T>& due) {
  collect(state.coil_resistance, {sample.current_A, sample.voltage_V, state.coil.flux_rate_V}, sample.time_step_s);
  const auto waited = [&] { return state.coil_resistance.collected_s > due.since_s() - T(0.5) * sample.time_step_s; };
  if (due.now && waited() && is_number(sample.voltage_V)) {
    const CoilResistance<T>& coil = actuator.coil_resistance;
    const T least_A = T(resistance_current_share) * largest_current_A;
    follow_resistance(coil, state.coil_resistance, {take_up(state.coil_resistance), least_A});
    judge_answer(coil, state.coil_resistance, T(unanswered_voltage_share) * largest_current_A * coil.resistance_Ohm);
  }
}

template <class T>
constexpr Cell<T> flux_position(const ActuatorParameters<T>& actuator, T position_m) {
  return locate<flux_map_positions>(actuator.coil.flux_linkage.map.column_axis, position_m);
}

/// Nothing is known of the coil's history.
template <class T>
SPOOLFLOW_NOINLINE constexpr void begin(const ActuatorParameters<T>& actuator, ActuatorState<T>& state, T current_A,
                                        T position_m) {
  begin(actuator.coil, state.coil, current_A, flux_position(actuator, position_m));
  state.lowest_flux_Wb = state.highest_flux_Wb = state.coil.hysteresis.flux;
}

/// The coil's part of one sample: its flux linkage and magnetising current follow the coil current. It starts again at
/// the first, and where a coil current that no coil has, or a leap in time, left a flux that no coil has.
template <class T>
SPOOLFLOW_INLINE constexpr void magnetise(const ActuatorParameters<T>& actuator, ActuatorState<T>& state,
                                          const Sample<T>& sample) {
  const T current_A = state.coil.magnetising_current_A;
  const Cell<T> position = flux_position(actuator, sample.position_m);
  bool forgotten = false;  // which no current within the map is
  const Cell<T> current = flux_current(actuator.coil, current_A, [&] { forgotten = !is_number(current_A); });
  if (unlikely(forgotten)) {
    begin(actuator, state, sample.current_A, sample.position_m);
    return;
  }
  solve_current(actuator.coil, state.coil, {sample.time_step_s, sample.current_A},
                {current_A, actuator.coil.flux_linkage.map.at(current, position)});
}

/// What the magnetic force may be wrong by, and the armature's friction.
template <class T>
SPOOLFLOW_INLINE constexpr void judge_force(const ActuatorParameters<T>& actuator, ActuatorState<T>& state,
                                            const Cell<T>& current, const Cell<T>& position,
                                            T force_per_current_N_per_A, T eddy_A) {
  widen_flux_range(state);
  const T current_variance_A2 = squared(actuator.current_uncertainty_A) + squared(actuator.eddy_uncertainty * eddy_A) +
                                squared(unknown_memory_A(actuator, state));
  state.uncertainty_N =
      sqrt(squared(actuator.force_uncertainty_N) + squared(force_per_current_N_per_A) * current_variance_A2);
  state.friction_half_width_N = actuator.friction_N.at(current, position).value;
}

/// One sample after the first. `position_m` is free of faults and drift. Current and position must be finite; nothing
/// else of the sample is read. Any time step from 50 us to 5 ms. Uncertainty and friction, which are slow, may be those
/// of an earlier sample where they are not `judged`. `outside()` is called where current or position lie outside of the
/// force map.
template <class T, class Outside>
SPOOLFLOW_INLINE constexpr ActuatorEstimate<T> follow_force(const ActuatorParameters<T>& actuator,
                                                            ActuatorState<T>& state, const Sample<T>& sample,
                                                            bool judged, const Outside& outside) {
  magnetise(actuator, state, sample);
  const auto& force_map = actuator.magnetic_force.map;
  const Cell<T> current = locate<force_map_currents>(force_map.row_axis, state.coil.magnetising_current_A, outside);
  const Cell<T> position = locate<force_map_positions>(force_map.column_axis, sample.position_m, outside);
  const MapPoint<T> force = force_map.at(current, position);
  T force_N = force.value;
  if (judged)
    judge_force(actuator, state, current, position, force.row_slope, sample.current_A - state.coil.static_current_A);
  // Above the largest current of the map the force goes on with its slope, which saturation makes too large.
  const T largest_A = force_map.row_axis.at(force_map_currents - 1);
  if (unlikely(current.index == force_map_currents - 2 && state.coil.magnetising_current_A > largest_A)) {
    const T beyond_N = force.row_slope * (state.coil.magnetising_current_A - largest_A);
    force_N += beyond_N;
    if (judged) state.uncertainty_N += T(saturation_share) * beyond_N;
  }
  return {force_N, state.uncertainty_N, state.friction_half_width_N, force.row_slope, force.column_slope};
}

/// One sample, where the `first` begins.
template <class T>
constexpr ActuatorEstimate<T> step(const ActuatorParameters<T>& actuator, ActuatorState<T>& state,
                                   const Sample<T>& sample, bool first, bool judged = true) {
  if (first) forget(state.coil);
  bool inside = true;
  ActuatorEstimate<T> out = follow_force(actuator, state, sample, judged, [&] { inside = false; });
  out.inside_map = inside;
  return out;
}

}  // namespace spoolflow::sensor
