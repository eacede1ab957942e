#pragma once
/// From coil current to magnetising current: hysteresis and eddy currents taken off.
#include <type_traits>

#include "spoolflow/sensor/eddy_currents.hpp"
#include "spoolflow/sensor/magnetic_hysteresis.hpp"
#include "spoolflow/sensor/table.hpp"

namespace spoolflow::sensor {

inline constexpr int flux_map_currents = 21;
inline constexpr int flux_map_positions = 9;
inline constexpr int flux_map_currents_below_zero = 2;  ///< remanence leaves small negative magnetising currents

/// Flux linkage of the coil [Wb] over magnetising current [A] (rows; hysteresis and eddy currents taken off the coil
/// current) and spool position [m] (columns). Zero without magnetising current, rising with it. From the coil voltage
/// on the solenoid rig; paper section 2.2.
template <class T>
struct FluxLinkage {
  Map<T, flux_map_currents, flux_map_positions> map;
};

/// Steps towards the magnetising current in each sample; what they leave is taken up by the next.
inline constexpr int newton_steps = 2;
/// A step of time [s] is taken for no shorter: the flux rate divides by it.
inline constexpr double shortest_step_s = 1e-6;
/// The time [s] in which the coil is taken to have been brought to its first current: no eddy currents are left.
inline constexpr double slow_magnetisation_s = 1e6;

template <class T>
struct Coil {
  FluxLinkage<T> flux_linkage;
  MagneticHysteresis<T> hysteresis;  ///< current [A] over flux linkage [Wb]
  EddyCurrents<T> eddy_currents;
};

/// The coil's memory; {} is demagnetised.
template <class T>
struct CoilState {
  HysteresisState<T> hysteresis{};
  T magnetising_current_A{};
  T static_current_A{};  ///< magnetising and hysteresis current together
  T flux_rate_V{};
  T time_constant_s{};  ///< with which the eddy currents let the flux follow the coil current
};

static_assert(std::is_trivially_copyable_v<CoilState<float>>);

/// The coil current [A], mean over the step that ends now.
template <class T>
struct CoilStep {
  T time_step_s;
  T current_A;
};

/// The weight of the step's end in a mean over the step: one half where the step is short against the time constant
/// (trapezoidal rule), one where it is long (implicit Euler), so that any step is stable and short ones are exact to
/// second order. Close to the exponential fitting 1/(1 - exp(-1/a)) - a, a being time constant over step.
template <class T>
constexpr T end_weight(T time_constant_per_step) {
  return T(0.5) + T(0.5) / (T(1) + time_constant_per_step * (T(2) + T(3) * time_constant_per_step));
}

/// Where to begin: a magnetising current, and the flux linkage there.
template <class T>
struct CoilGuess {
  T current_A;
  MapPoint<T> flux;
};

/// Finds the magnetising current i_m at the step's end at which
///
///     i_m + hysteresis(flux) + eddy(d flux/dt) = i,   flux = flux_linkage(i_m, x),
///
/// in the mean over the step. Newton steps from `guess`; what they leave is taken up by the next sample. Only the first
/// asks every stop of the hysteresis, what follows goes along its slope.
template <class T>
[[gnu::always_inline]] constexpr void solve_current(const Coil<T>& coil, CoilState<T>& state, const CoilStep<T>& step,
                                                    const Cell<T>& position, const CoilGuess<T>& guess) {
  const auto& flux_map = coil.flux_linkage.map;
  const T per_step = T(1) / larger(step.time_step_s, T(shortest_step_s));
  const T weight = end_weight(state.time_constant_s * per_step);
  const T target_A = step.current_A - (T(1) - weight) * state.static_current_A;
  T current_A = guess.current_A;
  MapPoint<T> flux = guess.flux;
  T flux_Wb{}, asked_Wb{};
  HysteresisPoint<T> hysteresis{};
  for (int pass = 0; pass < newton_steps; ++pass) {
    if (pass > 0) flux = flux_map.at(locate<flux_map_currents>(flux_map.row_axis, current_A), position);
    if (pass == 0) {
      asked_Wb = flux.value;
      hysteresis = hysteresis_at(coil.hysteresis, state.hysteresis, flux.value);
    }
    const T hysteresis_A = hysteresis.value + hysteresis.slope * (flux.value - asked_Wb);
    const EddyCurrent<T> eddy = coil.eddy_currents.at((flux.value - state.hysteresis.flux) * per_step);
    state.time_constant_s = eddy.slope_A_per_V * flux.row_slope;
    const T slope = weight * (T(1) + hysteresis.slope * flux.row_slope) + state.time_constant_s * per_step;
    const T change_A = (target_A - weight * (current_A + hysteresis_A) - eddy.current_A) / slope;
    current_A += change_A;
    flux_Wb = flux.value + flux.row_slope * change_A;  // exact within a cell of the map
  }
  state.flux_rate_V = (flux_Wb - state.hysteresis.flux) * per_step;
  state.magnetising_current_A = current_A;
  state.static_current_A = current_A + hysteresis.value + hysteresis.slope * (flux_Wb - asked_Wb);
  advance(coil.hysteresis, state.hysteresis, flux_Wb);
}

template <class T>
constexpr void demagnetise(CoilState<T>& state) {
  demagnetise(state.hysteresis);
  state.static_current_A = T(0);
  state.time_constant_s = T(0);
}

/// Follows the coil current with the flux. The first sample begins: nothing is known of the coil's history, it is taken
/// to have been demagnetised and then brought to this current slowly. Costs no more than any other step.
template <class T>
[[gnu::always_inline]] constexpr void follow_current(const Coil<T>& coil, CoilState<T>& state, CoilStep<T> step,
                                                     const Cell<T>& position, Mask<T> begins) {
  const auto& flux_map = coil.flux_linkage.map;
  const T last_A = select(begins, step.current_A, state.magnetising_current_A);
  CoilGuess<T> guess{last_A, flux_map.at(locate<flux_map_currents>(flux_map.row_axis, last_A), position)};
  if (any(!begins)) {
    // Where the last flux rate would lead, along the map's line: exact within its cell.
    const T predicted_Wb = state.hysteresis.flux + state.flux_rate_V * step.time_step_s;
    const T predicted_A = guess.current_A + (predicted_Wb - guess.flux.value) / guess.flux.row_slope;
    guess.current_A = select(begins, guess.current_A, predicted_A);
    guess.flux.value = select(begins, guess.flux.value, predicted_Wb);
  }
  in_valves(begins, state, [&] { demagnetise(state); });
  step.time_step_s = select(begins, T(slow_magnetisation_s), step.time_step_s);
  solve_current(coil, state, step, position, guess);
  state.flux_rate_V = select(begins, T(0), state.flux_rate_V);
}

}  // namespace spoolflow::sensor
