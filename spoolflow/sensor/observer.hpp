#pragma once
/// The full soft sensor (paper Fig 3): spool position, actuator, spring, friction fed back from the estimated flow and
/// metering edge by temperature, with the pressure difference as the hidden state.
#include <limits>

#include "spoolflow/sensor/band.hpp"
#include "spoolflow/sensor/compiler.hpp"
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"
#include "spoolflow/sensor/pressure_update.hpp"

namespace spoolflow::sensor {

/// The oil warms slowly and its sensor is noisy [s].
inline constexpr double temperature_smoothing_s = 2;
/// No oil that a valve has is colder or warmer [K]: the sensor or its line is broken.
inline constexpr double coldest_oil_K = 233.15;
inline constexpr double warmest_oil_K = 423.15;
/// Nor does oil leap by more than this [K] from what it was; ...
inline constexpr double oil_leap_K = 15;
/// ... what has lasted for longer [s] is believed.
inline constexpr double longest_oil_fault_s = 20;
/// Of currents that leapt as no coil lets them so many in a row are replaced by the last credible one; what lasts is
/// believed.
inline constexpr int most_held_currents = 2;

namespace detail {

template <class T>
constexpr bool is_oil_temperature(T temperature_K) {
  return temperature_K > T(coldest_oil_K) && temperature_K < T(warmest_oil_K);
}

/// To be called before the first sample goes through the stages, and where time has leapt.
template <class T>
constexpr void begin(const ObserverParameters<T>& valve, ObserverState<T>& state, const Sample<T>& sample) {
  state.started = true;
  state.oil_temperature_K =
      (is_oil_temperature(sample.oil_temperature_K) ? sample.oil_temperature_K : valve.edge.temperature_K.at(1));
  state.oil_fault_s = T(0);
  state.held_currents = 0;
  const T position_m = drift_free_m(valve.position_sensor, sample.position_m, state.oil_temperature_K);
  sensor::begin(state.position, position_m);
  sensor::begin(state.dither, sample.current_A);  // without dither no swing is kept either
  sensor::begin(valve.friction, state.friction, position_m);
  sensor::begin(valve.pressure, state.pressure, valve.highest_pressure_difference_Pa(), valve.friction.operation_ratio,
                valve.band.unseen_factor);
}

/// The oil temperature reads what no oil has, or leapt, or did so before: believed only where a leap has lasted.
template <class T>
constexpr void judge_temperature(ObserverState<T>& state, T oil_temperature_K, bool odd, T since_s) {
  state.oil_fault_s = odd ? state.oil_fault_s + since_s : T(0);
  const bool lasted = is_oil_temperature(oil_temperature_K) && state.oil_fault_s > T(longest_oil_fault_s);
  if (lasted) state.oil_temperature_K = oil_temperature_K;
}

/// Where it is `due`. A missing oil temperature is held, and one that no oil has, too.
template <class T>
constexpr void follow_temperature(ObserverState<T>& state, T oil_temperature_K, bool due) {
  if (due && is_number(oil_temperature_K)) {
    const T since_s = slow_period_s(state.position);
    const T change_K = oil_temperature_K - state.oil_temperature_K;
    const bool odd = magnitude(change_K) > T(oil_leap_K) || !is_oil_temperature(oil_temperature_K);
    const T pace = smaller(since_s * T(1 / temperature_smoothing_s), T(1));
    state.oil_temperature_K += (odd ? T(0) : pace) * change_K;
    if (odd || state.oil_fault_s > T(0)) judge_temperature(state, oil_temperature_K, odd, since_s);
  }
}

/// What a coil shows whose armature does not move.
template <class T>
constexpr QuietCoil<T> quiet_coil(const ObserverParameters<T>& valve) {
  return {T(quiet_current_share) * valve.largest_current_A,
          T(quiet_voltage_share) * valve.largest_current_A * valve.actuator.coil_resistance.resistance_Ohm};
}

/// What the sample and its answer must be taken with.
template <class T>
SPOOLFLOW_INLINE constexpr auto status(const ObserverParameters<T>& valve, const ObserverState<T>& state,
                                       const Sample<T>& sample, const ForceBalance<T>& balance) {
  Status out{};
  mark(out, balance.closed, Status::closed);
  mark(out, !balance.sliding, Status::spool_at_rest);
  mark(out, balance.dithered, Status::dithered);
  mark(out, !balance.actuator.inside_map, Status::outside_force_map);
  const bool capped = !(state.pressure.pressure_difference_Pa < valve.highest_pressure_difference_Pa());
  mark(out, (!balance.edge.inside || capped) && !balance.closed, Status::outside_flow_force_map);
  mark(out, !balance.edge.temperature_inside, Status::outside_temperature);
  mark(out, sample.current_A > valve.largest_current_A, Status::current_saturated);
  mark(out, state.actuator.coil_resistance.implausible, Status::coil_fault);
  mark(out, state.oil_fault_s > T(0), Status::temperature_fault);
  return out;
}

/// Flow rate of this instant at the expected pressure difference, with its band; paper section 3. How far the pressure
/// difference may lie from the believed one is reckoned where it is its turn.
template <class T>
SPOOLFLOW_INLINE constexpr void answer(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                       const ForceBalance<T>& balance, const PositionPoint<T>& position, T current_A) {
  if (position.turn.even) {
    if (!is_bench(valve.environment))
      state.environment_N = environment_N(valve, state, balance, position.position_m, current_A);
    state.pressure.reach = pressure_reach(
        valve.band, state.pressure, balance, state.friction.rest_s, position.velocity_m_per_s,
        displaced_ratio(valve.pressure, state.pressure, valve.friction.operation_ratio), state.environment_N);
  }
  const PressureBand<T> band = pressure_band(state.pressure, valve.highest_pressure_difference_Pa());
  const T conductance = balance.edge.conductance;
  Estimate<T>& out = state.last;
  out.flow_m3_per_s = larger(conductance * sqrt(band.expected_Pa), T(0));
  band_of_flow(valve, conductance * sqrt(band.least_Pa), conductance * sqrt(band.most_Pa), out);
  admit_stall(balance, band.expected_Pa, valve.highest_pressure_difference_Pa(), out);
  out.pressure_difference_Pa = band.expected_Pa;
  out.magnetic_force_N = balance.actuator.magnetic_force_N;
  out.spring_force_N = balance.spring_N;
  out.flow_force_N = balance.edge.flow_force_N;
  out.friction_force_N = balance.friction_N;
}

/// Where a spool stands whose forces are not believed.
template <class T>
struct DoubtfulPlace {
  T position_m;
  T elsewhere_m;  ///< where it is instead, if it is not there
  bool fault;     ///< of the position signal
};

/// While the position signal may be wrong, or the current is, forces tell nothing: the flow where the spool is believed
/// to be, at the pressure difference last believed, and in the band what that may have become. It holds what flows at
/// the other place where the spool may be, too; beyond the centre as much as through the direction's own edge.
template <class T>
SPOOLFLOW_NOINLINE constexpr void answer_in_doubt(ObserverState<T>& state, const ObserverParameters<T>& valve,
                                                  const Sample<T>& sample, const DoubtfulPlace<T>& position,
                                                  T opposing_N, bool begins) {
  const ActuatorEstimate<T> actuator =
      step(valve.actuator, state.actuator, Sample<T>{sample.time_step_s, sample.current_A, {}, position.position_m, {}},
           begins, false);
  follow_coil(valve.actuator, state.actuator, sample, valve.largest_current_A, T(0), false);
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  drift_unseen(valve.pressure, state.pressure, sample.time_step_s, highest_Pa);
  const T believed_Pa = state.pressure.pressure_difference_Pa;
  const EdgePoint<T> edge = valve.edge.at(state.oil_temperature_K, believed_Pa, position.position_m);
  const PressureBand<T> band = unobserved_pressure_band(valve.band, state, edge, highest_Pa);
  Estimate<T>& out = state.last;
  out.pressure_difference_Pa = band.expected_Pa;
  out.flow_m3_per_s = edge.conductance * sqrt(band.expected_Pa);
  const T there = valve.edge.at(state.oil_temperature_K, believed_Pa, magnitude(position.elsewhere_m)).conductance;
  const T elsewhere = position.fault ? (position.elsewhere_m < T(0) ? -there : there) : edge.conductance;
  const CoilResistanceState<T>& coil = state.actuator.coil_resistance;
  const T least = sqrt(coil.unanswered ? T(0) : band.least_Pa);
  const T most = sqrt(coil.unanswered ? highest_Pa : band.most_Pa);
  band_of_flow(valve, smaller(edge.conductance * least, elsewhere * (elsewhere < T(0) ? most : least)),
               larger(edge.conductance, elsewhere) * most, out);
  out.magnetic_force_N = actuator.magnetic_force_N - opposing_N;
  out.spring_force_N = valve.spring.at(position.position_m).value;
  out.flow_force_N = edge.flow_force_N;
  out.friction_force_N = T(0);
  out.status = when(position.position_m < valve.closed_below_m, Status::closed);
  mark(out.status, !actuator.inside_map, Status::outside_force_map);
  mark(out.status, !edge.temperature_inside, Status::outside_temperature);
  mark(out.status, sample.current_A > valve.largest_current_A, Status::current_saturated);
  mark(out.status, position.fault, Status::position_fault);
  mark(out.status, coil.implausible || coil.unanswered, Status::coil_fault);
  mark(out.status, state.oil_fault_s > T(0), Status::temperature_fault);
}

/// Forces of this sample are to be believed: the place of the spool is known, and the current answers the voltage.
template <class T>
SPOOLFLOW_INLINE constexpr void observe_forces(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                               const Sample<T>& sample, const PositionPoint<T>& position,
                                               const Dither<T>& dither, T opposing_N, bool begins) {
  const ForceBalance<T> balance = balance_forces(valve, state, sample, position, dither, opposing_N, begins);
  state.force_noise_N = balance.noise_N;
  const T believed_Pa = state.pressure.pressure_difference_Pa;
  believe(valve, state, balance, position, sample.time_step_s);
  if (balance.dithered) {
    state.swing.flow_force_N +=
        balance.edge.flow_force_per_pressure_N_Pa * (state.pressure.pressure_difference_Pa - believed_Pa);
  }
  if (position.turn.even) follow_agreement(state.pressure);
  // Once a block, whatever the spool does.
  follow_coil(valve.actuator, state.actuator, sample, valve.largest_current_A, position.block_s, position.turn.busy);
  answer(valve, state, balance, position, sample.current_A);
  state.last.status = status(valve, state, sample, balance);
}

/// From where the spool is and what it does to the answer, which stays in the state. `opposing_N` is what another
/// solenoid holds against this one's.
template <class T>
SPOOLFLOW_INLINE constexpr void observe(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                        const Sample<T>& sample, const PositionPoint<T>& position,
                                        const Dither<T>& dither, T opposing_N, bool begins) {
  if (unlikely(position.fault || state.actuator.coil_resistance.unanswered)) {
    answer_in_doubt(state, valve, sample, {position.position_m, position.elsewhere_m, position.fault}, opposing_N,
                    begins);
    return;
  }
  observe_forces(valve, state, sample, position, dither, opposing_N, begins);
}

/// Whether the current leapt since the last sample as the coil's equation allows none: `jump_A` at once, and as voltage
/// over incremental inductance with the time.
template <class T>
SPOOLFLOW_INLINE constexpr bool current_leaps(const CurrentLimits<T>& limits, T last_A, const Sample<T>& sample) {
  return magnitude(sample.current_A - last_A) > limits.jump_A + limits.slope_A_per_s * sample.time_step_s &&
         limits.jump_A > T(0);
}

/// Of a current that leapt: whether the last credible one is taken for it. Once more in a row.
template <class T>
constexpr bool is_held(ObserverState<T>& state) {
  const bool held = state.held_currents < most_held_currents;
  state.held_currents = held ? state.held_currents + 1 : 0;
  return held;
}

/// The sample, or where its current leapt with the last credible one, and no voltage.
template <class T>
SPOOLFLOW_INLINE constexpr const Sample<T>& credible(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                                     const Sample<T>& measured, Sample<T>& held) {
  const bool leaps = current_leaps(valve.current_limits, state.position.current_A, measured);
  if (likely(!leaps || !is_held(state))) {
    if (!leaps) state.held_currents = 0;
    return measured;
  }
  constexpr T missing = std::numeric_limits<T>::quiet_NaN();
  held = {measured.time_step_s, state.position.current_A, missing, measured.position_m, measured.oil_temperature_K};
  return held;
}

/// The band takes in all that may flow through the other direction's edge.
template <class T>
SPOOLFLOW_NOINLINE constexpr void admit_all(const ObserverParameters<T>& valve, ObserverState<T>& state, T position_m,
                                            bool opens) {
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  const T most = valve.edge.at(state.oil_temperature_K, highest_Pa, -position_m).conductance * sqrt(highest_Pa);
  Estimate<T>& out = state.last;
  if (opens) out.flow_lower_m3_per_s = smaller(out.flow_lower_m3_per_s, -most);
  mark(out.status, opens, Status::other_direction);
}

/// A model of one direction knows nothing of the other, where as much may flow as through its own edge.
template <class T>
SPOOLFLOW_INLINE constexpr void admit_other_direction(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                                      T position_m) {
  const bool opens = position_m < T(-0.5) * valve.closed_below_m - T(other_direction_m);
  if (unlikely(opens)) admit_all(valve, state, position_m, opens);
}

/// See sensor::hold. A call of its own, with its arguments in an order that costs the step nothing.
template <class T>
SPOOLFLOW_NOINLINE constexpr void hold(ObserverState<T>& state, const Sample<T>& sample,
                                       const ObserverParameters<T>& valve) {
  const T time_step_s = sample.time_step_s;
  const bool leapt = time_step_s > T(longest_step_s);  // not where it is no number
  const bool seen = is_number(sample.position_m);
  const T measured_m = drift_free_m(valve.position_sensor, sample.position_m, state.oil_temperature_K);
  if (state.started && within(time_step_s, T(endless_step_s))) {
    widen_held(valve, state, {seen ? measured_m : state.position.last_m, seen}, time_step_s, state.last);
  }
  state.started = state.started && !leapt;
  state.last.status = unusable(sample) | when(leapt, Status::time_fault);
  admit_other_direction(valve, state, seen ? measured_m : T(0));
}

}  // namespace detail

/// A sample that cannot be used: the last flow is held, its band opens for as long as that lasts, and the status says
/// why. After a leap of time the sensor begins anew with the next one.
template <class T>
constexpr void hold(const ObserverParameters<T>& valve, ObserverState<T>& state, const Sample<T>& sample) {
  detail::hold(state, sample, valve);
}

/// One sample through the chain of paper Fig 3. Needs current and position, and a time that does not run backwards:
/// otherwise the last flow is held (`hold`); after a leap of time it begins anew. A missing oil temperature is held;
/// the voltage tells of the coil alone and may be missing. The answer stays in the state.
template <class T>
constexpr const Estimate<T>& step(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                  const Sample<T>& measured) {
  bool begins = !state.started, late = false;
  if (unlikely(!ordinary(measured))) {
    begins = begins || time_leapt(measured.time_step_s);
    late = is_late(measured.time_step_s);
    if (unusable(measured) != Status::none) {
      detail::hold(state, measured, valve);
      return state.last;
    }
  }
  Sample<T> held;
  const Sample<T>& sample = begins ? measured : detail::credible(valve, state, measured, held);
  if (begins) detail::begin(valve, state, sample);
  const Dither<T> dither = follow_dither(state.dither, sample.current_A, valve.largest_current_A, sample.time_step_s);
  const PositionPoint<T> position = track(valve.position_sensor, state.position, sample, detail::quiet_coil(valve),
                                          state.oil_temperature_K, dither, state.swing.frees);
  detail::follow_temperature(state, sample.oil_temperature_K, position.turn.slow_odd);
  detail::observe(valve, state, sample, position, dither, T(0), begins);
  detail::admit_other_direction(valve, state, position.position_m);
  if (late) state.last.status |= Status::time_fault;
  if (unlikely(state.held_currents > 0)) state.last.status |= Status::current_fault;
  return state.last;
}

}  // namespace spoolflow::sensor
