#pragma once
/// The full soft sensor (paper Fig 3): spool position, actuator, spring, friction fed back from the estimated flow and
/// metering edge by temperature, with the pressure difference as the hidden state. Each stage has its own part of the
/// state; only this file sees it whole.
#include "spoolflow/sensor/band.hpp"
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/held_answer.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"
#include "spoolflow/sensor/other_direction.hpp"
#include "spoolflow/sensor/pressure_update.hpp"
#include "spoolflow/sensor/schedule.hpp"

namespace spoolflow::sensor {

namespace detail {

/// Where the oil temperature that is followed lies, and what must be said of it.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_layer(const ObserverParameters<T>& valve, ObserverState<T>& state) {
  const OilLayer<T> layer = valve.edge.layer_at(state.oil.temperature_K);
  state.oil_layer = layer.cell;
  if (unlikely(has(state.oil_status, Status::outside_temperature)) && layer.inside)
    state.force_errors.environment_N = T(0);
  state.oil_status =
      when(!layer.inside, Status::outside_temperature) | when(!is_zero(state.oil.fault_s), Status::temperature_fault);
}

/// The oil temperature, where it is due, and what it does to the position's zero.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_oil(const PositionSensor<T>& sensor, ObserverState<T>& state, T measured_K,
                                           const Due<T>& due) {
  follow_temperature(state.oil, measured_K, due);
  if (due.now) state.drift_m = drift_m(sensor, state.oil.temperature_K);
}

/// To be called before the first sample goes through the stages, and where time has leapt.
template <class T>
constexpr void begin(const ObserverParameters<T>& valve, ObserverState<T>& state, const Sample<T>& sample) {
  state.started = true;
  sensor::begin(state.oil, sample.oil_temperature_K, valve.edge.temperature_K.at(1));
  state.held_currents = 0;
  state.unmoved_s = T(0);
  state.drift_m = drift_m(valve.position_sensor, state.oil.temperature_K);
  const T position_m = sample.position_m - state.drift_m;
  sensor::begin(state.position, position_m);
  forget(state.actuator.coil);
  sensor::begin(state.dither, sample.current_A);  // without dither no swing is kept either
  sensor::begin(valve.friction, state.friction, position_m);
  sensor::begin(valve.pressure, state.pressure, valve.highest_pressure_difference_Pa(), valve.friction.operation_ratio,
                valve.band.unobserved_factor);
}

/// What a coil shows whose armature does not move.
template <class T>
constexpr QuietCoil<T> quiet_coil(const ObserverParameters<T>& valve) {
  return {T(quiet_current_share) * valve.largest_current_A,
          T(quiet_voltage_share) * valve.largest_current_A * valve.actuator.coil_resistance.resistance_Ohm};
}

/// By how much the current may have changed since the last sample [A], in size, beside eddy currents: what the spool's
/// travel from `position_m` makes of it, and what the voltages drive of the fastest change. A call of its own: seldom
/// asked.
template <class T>
SPOOLFLOW_NOINLINE constexpr T possible_change_A(const ObserverParameters<T>& valve, const ObserverState<T>& state,
                                                 const Sample<T>& sample, T position_m, T travel_m, T fastest_A) {
  const ActuatorParameters<T>& actuator = valve.actuator;
  const T last_A = state.position.coil.current_A;
  const CoilDrive<T> drive{last_A, sample.voltage_V, state.position.coil.voltage_V, sample.time_step_s};
  return fastest_A * driven_share(actuator.coil_resistance, drive, valve.largest_voltage_V, valve.largest_current_A) +
         moved_current_A(actuator.coil, last_A, position_m, travel_m);
}

/// The sample, or that with the last credible current where its own leapt.
template <class T>
SPOOLFLOW_INLINE constexpr const Sample<T>& credible(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                                     const Sample<T>& measured, Status& faults) {
  const T last_A = state.position.coil.current_A;
  const bool holds = is_held(
      valve.current_limits, {last_A, measured.current_A}, measured.time_step_s, state.held_currents, [&](T fastest_A) {
        const T last_m = state.position.last_m;
        return possible_change_A(valve, state, measured, last_m, measured.position_m - last_m, fastest_A);
      });
  state.held_currents = held_in_a_row(state.held_currents, holds);
  if (likely(!holds)) return measured;
  faults |= Status::current_fault;
  state.held = with_current(measured, last_A);
  return state.held;
}

/// The actuator's part of a sample, at the position that is free of drift and faults.
template <class T>
SPOOLFLOW_INLINE constexpr ActuatorEstimate<T> net_actuator(const ObserverParameters<T>& valve, ActuatorState<T>& state,
                                                            const Sample<T>& sample, T position_m, T opposing_N,
                                                            bool judged, Status& status) {
  ActuatorEstimate<T> out =
      follow_force(valve.actuator, state, Sample<T>{sample.time_step_s, sample.current_A, {}, position_m, {}}, judged,
                   [&] { status |= Status::outside_force_map; });
  out.magnetic_force_N -= opposing_N;
  return out;
}

/// What the sample and its answer must be taken with, beside what oil and tables have said.
template <class T>
SPOOLFLOW_INLINE constexpr void mark_answer(const ObserverParameters<T>& valve, const ObserverState<T>& state,
                                            const Sample<T>& sample, const ForceBalance<T>& balance, Status& status) {
  if (unlikely(is_capped(state.pressure, valve.highest_pressure_difference_Pa())) && !balance.closed)
    status |= Status::outside_flow_force_map;
  mark(status, !balance.sliding, Status::spool_at_rest);
  mark(status, sample.current_A > valve.largest_current_A, Status::current_saturated);
  mark(status, state.actuator.coil_resistance.implausible, Status::coil_fault);
}

/// What is left open of the pressure difference, computed where it is due.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_half_widths(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                                   const ForceBalance<T>& balance, const PositionPoint<T>& position,
                                                   T current_A, bool outside_temperature) {
  PressureState<T>& pressure = state.pressure;
  follow_agreement(pressure);
  if (!is_bench(valve.environment) || outside_temperature) {
    T& open_N = state.force_errors.environment_N;
    open_N = continued_oil_N(valve.edge, state.oil_layer.share, balance.edge, pressure.pressure_difference_Pa);
    if (!is_bench(valve.environment))
      open_N +=
          environment_N(valve,
                        EnvironmentEffects<T>{balance.edge, balance.actuator.force_per_position_N_per_m,
                                              balance.actuator.force_per_current_N_per_A, balance.bounds.sliding_N,
                                              balance.spool_friction_N + balance.armature_friction_N, balance.dithered},
                        {in_tables(state.oil_layer), pressure.pressure_difference_Pa, position.position_m, current_A,
                         pressure.breakaway_Pa});
  }
  pressure.half_widths = pressure_half_widths(
      valve.band, pressure, balance, state.friction.rest_s, position.velocity_m_per_s,
      displaced_ratio(valve.pressure, pressure, valve.friction.operation_ratio), state.force_errors.environment_N);
}

/// Flow rate of this instant at the expected pressure difference, with its band; paper section 3.
template <class T>
SPOOLFLOW_INLINE constexpr void answer(const ObserverParameters<T>& valve, const PressureState<T>& pressure,
                                       const ForceBalance<T>& balance, Estimate<T>& out) {
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  const T conductance = at_least_zero(balance.edge.conductance);
  const PressureBand<T> band = pressure_band(pressure, pressure.half_widths, highest_Pa);
  out.pressure_difference_Pa = band.expected_Pa;
  out.flow_m3_per_s = conductance * sqrt(band.expected_Pa);
  band_of_flow(valve, conductance * sqrt(band.least_Pa), conductance * sqrt(band.most_Pa), out);
  admit_stall(balance, out.pressure_difference_Pa, highest_Pa, out);
  out.magnetic_force_N = balance.actuator.magnetic_force_N;
  out.spring_force_N = balance.spring_N;
  out.flow_force_N = balance.edge.flow_force_N;
  out.friction_force_N = balance.friction_N;
}

/// While the position signal or the current may be wrong, and on the open stop, which holds what flow force and
/// friction do not, forces are no evidence: the flow where the spool is thought to stand, at the last estimate of the
/// pressure difference, and in the band what that may have become. It holds what flows at the other place where the
/// spool may be, too.
template <class T>
SPOOLFLOW_NOINLINE constexpr void answer_in_doubt(ObserverState<T>& state, const ObserverParameters<T>& valve,
                                                  const Sample<T>& sample, const DoubtfulPlace<T>& position,
                                                  T opposing_N, Status faults) {
  Status status = state.oil_status | faults;
  const ActuatorEstimate<T> actuator =
      net_actuator(valve, state.actuator, sample, position.position_m, opposing_N, false, status);
  follow_coil(valve.actuator, state.actuator, sample, valve.largest_current_A, {true, T(0), T(0)});
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  drift_unobserved(valve.pressure, state.pressure, sample.time_step_s, highest_Pa);
  const EdgePoint<T> edge = valve.edge.at(state.oil_layer, state.pressure.pressure_difference_Pa, position.position_m);
  const PressureHalfWidths<T> widths = unobserved_half_widths(valve.band, state.pressure, state.force_errors, edge);
  PressureBand<T> band = pressure_band(state.pressure, widths, highest_Pa);
  const CoilResistanceState<T>& coil = state.actuator.coil_resistance;
  if (coil.unanswered || position.stopped) band = {T(0), band.expected_Pa, highest_Pa};
  Estimate<T>& out = state.last;
  answer_flow(valve, passage_at(valve.edge, edge, {state.pressure, state.force_errors, state.oil_layer}, position),
              band, out);
  out.magnetic_force_N = actuator.magnetic_force_N;
  out.spring_force_N = valve.spring.at(position.position_m).value;
  out.flow_force_N = edge.flow_force_N;
  out.friction_force_N = T(0);
  mark(status, position.position_m < valve.closed_below_m, Status::closed);
  mark(status, sample.current_A > valve.largest_current_A, Status::current_saturated);
  mark(status, position.stopped, Status::open_stop);
  mark(status, position.fault, Status::position_fault);
  mark(status, coil.implausible || coil.unanswered, Status::coil_fault);
  out.status = status;
}

/// A position that says that the spool rests and covers the edge, against forces that move any spool, is wrong: the
/// spool may stand anywhere on the side to which they push.
template <class T>
SPOOLFLOW_NOINLINE constexpr void judge_closed(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                               const ClosedForces<T>& forces, T time_step_s) {
  const T way = way_of(forces);
  if (is_zero(way) || state.position.motion != Motion::rest) {
    state.unmoved_s = T(0);
    return;
  }
  state.unmoved_s += smaller(time_step_s, T(longest_regular_step_s));
  if (!(state.unmoved_s > T(longest_unmoved_s))) return;
  state.position.fault_s = larger(time_step_s, T(shortest_step_s));
  state.position.elsewhere_m = forces.side * way * valve.edge.position_m.at(edge_positions - 1) - state.position.last_m;
}

/// Pressure difference from the balance of forces, and what it makes of friction.
template <class T>
SPOOLFLOW_INLINE constexpr void update_pressure(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                                const ForceBalance<T>& balance, const PositionPoint<T>& position,
                                                const Schedule<T>& schedule, T time_step_s, Status& status) {
  PressureState<T>& pressure = state.pressure;
  const T prior_Pa = pressure.pressure_difference_Pa;
  const T to_friction_N =
      update(valve, pressure, balance, {schedule.friction_ratio, schedule.process_noise, time_step_s}, [&] {
        status = without(status, Status::outside_flow_force_map) | Status::closed;
        judge_closed(valve, state, closed_forces(balance, state.force_errors.environment_N, position), time_step_s);
      });
  if (!is_zero(to_friction_N)) correct_friction(state.friction, balance, to_friction_N);
  if (balance.dithered) {
    status |= Status::dithered;
    state.swing.flow_force_N +=
        balance.edge.flow_force_per_pressure_N_Pa * (pressure.pressure_difference_Pa - prior_Pa);
  }
}

/// The chain of the paper's Fig 3 where the place of the spool is known and the current answers the voltage.
template <class T>
SPOOLFLOW_INLINE constexpr void observe_forces(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                               const Sample<T>& sample, const PositionPoint<T>& position,
                                               const Dither<T>& dither, const Schedule<T>& schedule, T opposing_N,
                                               Status faults = {}) {
  Status status = state.oil_status | faults;
  // Magnetic force.
  const ActuatorEstimate<T> actuator =
      net_actuator(valve, state.actuator, sample, position.position_m, opposing_N, schedule.force_uncertainty, status);

  // Axial force and friction.
  const T spring_N = valve.spring.at(position.position_m).value;
  const EdgePoint<T> edge = valve.edge.at(state.oil_layer, state.pressure.pressure_difference_Pa, position.position_m,
                                          [&] { status |= Status::outside_flow_force_map; });
  const ForceBalance<T> balance = balance_forces(
      valve, {state.friction, state.swing}, {actuator, spring_N, edge, state.pressure.friction_ratio}, position, dither,
      {schedule.slip_excess, schedule.friction_memory, state.dither.period_s, sample.time_step_s});
  state.force_errors.noise_N = balance.noise_N;

  // Flow force: what friction cannot be moves the pressure difference.
  update_pressure(valve, state, balance, position, schedule, sample.time_step_s, status);
  follow_coil(valve.actuator, state.actuator, sample, valve.largest_current_A, schedule.coil_diagnosis);

  // Flow rate and its band.
  if (schedule.band)
    follow_half_widths(valve, state, balance, position, sample.current_A, has(status, Status::outside_temperature));
  answer(valve, state.pressure, balance, state.last);
  mark_answer(valve, state, sample, balance, status);
  state.last.status = status;
}

/// From where the spool is and what it does to the answer, which stays in the state. `opposing_N` is what another
/// solenoid holds against this one's.
template <class T>
SPOOLFLOW_INLINE constexpr void observe(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                        const Sample<T>& sample, const PositionPoint<T>& position,
                                        const Dither<T>& dither, const Schedule<T>& schedule, T opposing_N,
                                        Status faults = {}) {
  if (schedule.oil_temperature.now) follow_layer(valve, state);
  const auto stopped = [&] { return lies_below(valve.stopped_above_m, position.position_m); };
  if (unlikely(is_doubted(state.position) || state.actuator.coil_resistance.unanswered || stopped())) {
    answer_in_doubt(state, valve, sample,
                    {position.position_m, elsewhere_m(state.position, position), is_doubted(state.position), stopped()},
                    opposing_N, faults);
    return;
  }
  observe_forces(valve, state, sample, position, dither, schedule, opposing_N, faults);
}

/// See sensor::hold. A call of its own, with its arguments in an order that costs the step nothing.
template <class T>
SPOOLFLOW_NOINLINE constexpr void hold(ObserverState<T>& state, const Sample<T>& sample,
                                       const ObserverParameters<T>& valve) {
  const T time_step_s = sample.time_step_s;
  const bool leapt = time_step_s > T(longest_step_s);  // not where it is no number
  const bool seen = is_number(sample.position_m);
  const T measured_m = drift_free_m(valve.position_sensor, sample.position_m, state.oil.temperature_K);
  if (state.started && within(time_step_s, T(endless_step_s))) {
    if (seen) follow_unobserved(valve.position_sensor, state.position, measured_m, time_step_s);
    widen_held(valve, {state.pressure, state.force_errors, state.oil_layer},
               {seen ? measured_m : state.position.last_m, seen}, time_step_s, state.last);
  }
  state.started = state.started && !leapt;
  if (!state.started) open_band(state.last, {T(0), most_flow(valve)}, true, T(0));
  state.last.status = unusable(sample) | when(leapt, Status::time_fault);
  admit_other_direction(valve, state.oil_layer, seen ? measured_m : T(0), state.last);
}

}  // namespace detail

/// A sample that cannot be used: the last flow is held, its band opens for as long as that lasts, and the status says
/// why. After a leap of time the sensor starts again with the next one.
template <class T>
constexpr void hold(const ObserverParameters<T>& valve, ObserverState<T>& state, const Sample<T>& sample) {
  detail::hold(state, sample, valve);
}

/// One sample through the chain of paper Fig 3. Needs current and position, and a time that does not run backwards:
/// otherwise the last flow is held (`hold`); after a leap of time it starts again. A missing oil temperature is held;
/// the voltage serves the coil's diagnosis alone and may be missing. The answer stays in the state.
template <class T>
constexpr const Estimate<T>& step(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                  const Sample<T>& measured) {
  bool begins = !state.started;
  Status faults{};
  if (unlikely(!ordinary(measured))) {
    if (unusable(measured) != Status::none) {
      detail::hold(state, measured, valve);
      return state.last;
    }
    mark(faults, is_irregular(measured.time_step_s) && !(begins && is_zero(measured.time_step_s)), Status::time_fault);
    begins = begins || time_leapt(measured.time_step_s);
  }
  const Sample<T>& sample = begins ? measured : detail::credible(valve, state, measured, faults);
  if (begins) detail::begin(valve, state, sample);
  const Dither<T> dither = follow_dither(state.dither, sample.current_A, valve.largest_current_A, sample.time_step_s);
  const PositionPoint<T> position =
      track(valve.position_sensor, state.position, sample, detail::quiet_coil(valve), state.drift_m, dither,
            state.swing.frees, [&] { return elastic_m(valve.friction, state.friction); });
  const Schedule<T> schedule = detail::schedule_of(position.block);
  detail::follow_oil(valve.position_sensor, state, sample.oil_temperature_K, schedule.oil_temperature);
  detail::observe(valve, state, sample, position, dither, schedule, T(0), faults);
  if (has(state.last.status, Status::closed))
    admit_other_direction(valve, state.oil_layer, position.position_m, state.last);
  return state.last;
}

}  // namespace spoolflow::sensor
