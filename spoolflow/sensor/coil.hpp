#pragma once
/// From coil current to magnetising current: hysteresis and eddy currents taken off.
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/table.hpp"
#include "spoolflow/sensor/magnetic_hysteresis.hpp"

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

template <class T>
struct EddyCurrent {
  T current_A;
  T slope_A_per_V;
};

/// Currents that a changing flux drives in the iron, as seen from the coil: they carry part of the coil current that
/// makes no flux. A classical part in proportion to the rate of the flux linkage [V] and an excess part with its square
/// root. Bertotti, Hysteresis in Magnetism (1998), chapter 12; one stage of a Cauer ladder with a nonlinear branch.
/// Omits the delay with which flux enters the core (further stages).
template <class T>
struct EddyCurrents {
  T classical_A_per_V{};
  T excess_A_per_rootV{};
  T smallest_rate_V{T(1)};  ///< > 0; below it the excess part becomes proportional, too

  [[nodiscard]] constexpr EddyCurrent<T> at(T flux_rate_V) const {
    const T size = magnitude(flux_rate_V);
    const T per_rate = T(1) / (size + smallest_rate_V);  // beside the root, on which it need not wait
    const T share = size * per_rate;                     // 0 where proportional, 1 where the root law holds
    const T excess = excess_A_per_rootV * (sqrt(size + smallest_rate_V) * per_rate);
    return {(classical_A_per_V + excess) * flux_rate_V, classical_A_per_V + excess * (T(1) - T(0.5) * share)};
  }
};

/// A step of time [s] is taken for no shorter: the flux rate divides by it.
inline constexpr double shortest_step_s = 1e-6;

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

/// Where a step begins: a magnetising current, and the flux linkage there.
template <class T>
struct CoilGuess {
  T current_A;
  MapPoint<T> flux;
};

/// Where the step leads to first order, from `guess` at the last magnetising current and the new position. The time
/// constant is the last one; the flux that the position alone has moved counts as a change, too. Close enough for
/// hysteresis to be asked there, also where dither has turned the current round between two samples.
template <class T>
SPOOLFLOW_INLINE constexpr T predicted_change_A(const CoilState<T>& state, const CoilGuess<T>& guess, T current_A,
                                                T weight, T time_constant_per_step) {
  const T moved_A = (guess.flux.value - state.hysteresis.flux) / guess.flux.row_slope;
  return (current_A - state.static_current_A - time_constant_per_step * moved_A) / (weight + time_constant_per_step);
}

/// Finds the magnetising current i_m at the step's end at which
///
///     i_m + hysteresis(flux) + eddy(d flux/dt) = i,   flux = flux_linkage(i_m, x),
///
/// in the mean over the step: one Newton step from the prediction. What it leaves is taken up by the next sample.
template <class T>
SPOOLFLOW_INLINE constexpr void solve_current(const Coil<T>& coil, CoilState<T>& state, const CoilStep<T>& step,
                                              const CoilGuess<T>& guess) {
  const T per_step = T(1) / larger(step.time_step_s, T(shortest_step_s));
  const T time_constant_per_step = state.time_constant_s * per_step;
  const T weight = end_weight(time_constant_per_step);
  const T target_A = step.current_A - (T(1) - weight) * state.static_current_A;
  const T predicted_A = predicted_change_A(state, guess, step.current_A, weight, time_constant_per_step);
  const T guessed_A = guess.current_A + predicted_A;
  const T guessed_Wb = guess.flux.value + guess.flux.row_slope * predicted_A;
  const HysteresisPoint<T> hysteresis = hysteresis_at(coil.hysteresis, state.hysteresis, guessed_Wb);
  const EddyCurrent<T> eddy = coil.eddy_currents.at((guessed_Wb - state.hysteresis.flux) * per_step);
  state.time_constant_s = eddy.slope_A_per_V * guess.flux.row_slope;
  const T slope = weight * (T(1) + hysteresis.slope * guess.flux.row_slope) + state.time_constant_s * per_step;
  const T change_A = (target_A - weight * (guessed_A + hysteresis.value) - eddy.current_A) / slope;
  const T change_Wb = guess.flux.row_slope * change_A;
  const T flux_Wb = guessed_Wb + change_Wb;  // exact within a cell of the map
  state.flux_rate_V = (flux_Wb - state.hysteresis.flux) * per_step;
  state.magnetising_current_A = guessed_A + change_A;
  state.static_current_A = state.magnetising_current_A + hysteresis.value + hysteresis.slope * change_Wb;
  advance(coil.hysteresis, state.hysteresis, flux_Wb);
}

/// By how much a motion changes the current [A], in size, while the flux linkage stays: what the coil's equation
/// u = R i + d flux/dt has of the spool's velocity.
template <class T>
constexpr T moved_current_A(const Coil<T>& coil, T current_A, T position_m, T travel_m) {
  const MapPoint<T> flux = coil.flux_linkage.map.at(current_A, position_m);
  return at_least_zero(magnitude(flux.column_slope * travel_m) / flux.row_slope);
}

/// Where a magnetising current lies in the flux map; `outside()` is called where it lies beyond it.
template <class T, class Outside>
constexpr Cell<T> flux_current(const Coil<T>& coil, T current_A, const Outside& outside) {
  return locate<flux_map_currents>(coil.flux_linkage.map.row_axis, current_A, outside);
}

template <class T>
constexpr CoilGuess<T> guess_at(const Coil<T>& coil, T current_A, const Cell<T>& position) {
  return {current_A, coil.flux_linkage.map.at(flux_current(coil, current_A, [] {}), position)};
}

/// The first sample. Nothing is known of the coil's history, so that the iron is taken to lie in the middle of its
/// loops, at rest.
template <class T>
constexpr void begin(const Coil<T>& coil, CoilState<T>& state, T current_A, const Cell<T>& position) {
  const MapPoint<T> flux = guess_at(coil, current_A, position).flux;
  demagnetise(state.hysteresis, flux.value);
  state.magnetising_current_A = state.static_current_A = current_A;
  state.flux_rate_V = T(0);
  state.time_constant_s = coil.eddy_currents.at(T(0)).slope_A_per_V * flux.row_slope;
}

/// The coil begins again with the next sample: no coil has this current.
template <class T>
constexpr void forget(CoilState<T>& state) {
  state.magnetising_current_A = T(1 << 30);
}

/// Follows the coil current with the flux.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_current(const Coil<T>& coil, CoilState<T>& state, const CoilStep<T>& step,
                                               const Cell<T>& position, bool begins = false) {
  if (begins) {
    begin(coil, state, step.current_A, position);
  } else {
    solve_current(coil, state, step, guess_at(coil, state.magnetising_current_A, position));
  }
}

}  // namespace spoolflow::sensor
