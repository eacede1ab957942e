#pragma once
/// The whole 4/3 valve: one spool between two solenoids, which opens P to B on one side of the centre and P to A on the
/// other. Whichever side the spool stands on, the chain is that of one direction (observer.hpp) with the net force of
/// both solenoids; what is known of the other path waits, and grows uncertain, until the spool comes back.
#include <utility>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/whole_valve/measured_answer.hpp"
#include "spoolflow/sensor/whole_valve/mirrored.hpp"
#include "spoolflow/sensor/whole_valve/unsettled_load.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_parameters.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_sample.hpp"

namespace spoolflow::sensor {

/// The spool has changed sides where it stands so far beyond the centre [m].
inline constexpr double centre_hysteresis_m = 10e-6;
/// A reading nearer to the centre than this [m] may be of a spool that the springs centre: zero drift, play, ...
inline constexpr double centring_m = 60e-6;
/// ... and is, when both coils have been silent and the spool has rested there for so long [s]; ...
inline constexpr double centring_rest_s = 0.2;
/// ... the zero follows it at this pace [s].
inline constexpr double zero_following_s = 2;
/// How far from the centre the sign of the flow is not sure [m], beyond so many standard deviations of the noise.
inline constexpr double sign_margin_m = 5e-6;
inline constexpr double sign_deviations = 5;
/// The iron of a coil has come to rest where its current has been silent for so long [s].
inline constexpr double idle_settling_s = 0.1;

/// ... and until then its flux waits for a sample that has less else to do, but not for longer [s].
inline constexpr double idle_patience_s = 1.5e-3;

namespace detail {

template <class T>
struct Sides {
  const ObserverParameters<T>& open;
  const ObserverParameters<T>& idle;
};

template <class T>
constexpr Sides<T> sides(const WholeValveParameters<T>& valve, bool opens_a) {
  return opens_a ? Sides<T>{*valve.a, *valve.b} : Sides<T>{*valve.b, *valve.a};
}

/// To be called before the first sample: nothing is known of either path.
template <class T>
constexpr void begin(const WholeValveParameters<T>& valve, WholeValveState<T>& state,
                     const WholeValveSample<T>& sample) {
  state.opens_a = sample.position_m < T(0);
  const Sides<T> now = sides(valve, state.opens_a);
  begin(now.open, state.open, sample_of(sample, state.opens_a));
  state.open.drift_m = drift_m(valve.b->position_sensor, state.open.oil.temperature_K);
  sensor::begin(state.open.position, sample.position_m - state.open.drift_m);
  forget(state.idle.actuator.coil);
  sensor::begin(now.idle.pressure, state.idle.pressure, now.idle.highest_pressure_difference_Pa(),
                now.idle.friction.operation_ratio, now.idle.band.unobserved_factor);
  state.idle.held_currents = 0;
  sensor::begin(state.idle.dither, sample_of(sample, !state.opens_a).current_A);
  state.idle.waiting_s = state.idle.charge_As = T(0);
  state.settled_m3_per_s = T(0);
  state.inlet_share = now.open.inlet.share;
  state.idle.inlet_share = now.idle.inlet.share;
}

/// In pieces so small that no compiler wants a library to move them.
template <class T>
constexpr void exchange(ActuatorState<T>& one, ActuatorState<T>& other) {
  std::swap(one.coil, other.coil);
  std::swap(one.coil_resistance, other.coil_resistance);
  std::swap(one.lowest_flux_Wb, other.lowest_flux_Wb);
  std::swap(one.highest_flux_Wb, other.highest_flux_Wb);
}

/// The spool went through the centre: the other solenoid and the other path are at work. What the supply did to it
/// meanwhile is unobserved.
template <class T>
constexpr void change_sides(const WholeValveParameters<T>& valve, WholeValveState<T>& state) {
  state.opens_a = !state.opens_a;
  const ObserverParameters<T>& open = sides(valve, state.opens_a).open;
  exchange(state.open.actuator, state.idle.actuator);
  std::swap(state.open.pressure, state.idle.pressure);
  std::swap(state.open.dither, state.idle.dither);
  std::swap(state.open.held_currents, state.idle.held_currents);
  std::swap(state.inlet_share, state.idle.inlet_share);
  state.settled_m3_per_s = -state.settled_m3_per_s;
  mirror(state.open.friction);
  forget(state.open.swing);
  PressureState<T>& pressure = state.open.pressure;
  expect_change(open.pressure, pressure);
  drift_unobserved(open.pressure, pressure, state.idle.closed_s, open.highest_pressure_difference_Pa());
  state.idle.magnetic_force_N = magnitude(state.open.last.magnetic_force_N);
  state.idle.closed_s = state.idle.quiet_s = state.idle.waiting_s = state.idle.charge_As = T(0);
}

/// What the solenoid on the other side holds [N, >= 0]: its iron keeps some of it when the current is gone. It is slow
/// enough that its flux waits for a sample that is not `busy` otherwise, and then takes the mean current since; its
/// force is read in one that is.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_idle(const ObserverParameters<T>& valve, IdleSide<T>& idle,
                                            const Sample<T>& sample, bool begins, bool busy) {
  const bool just_left = !begins && is_zero(idle.closed_s);
  idle.closed_s += sample.time_step_s;
  if (!just_left) {
    const bool silent = magnitude(sample.current_A) < T(quiet_current_share) * valve.largest_current_A;
    idle.quiet_s = silent ? idle.quiet_s + sample.time_step_s : T(0);
    if (begins || !(idle.quiet_s > T(idle_settling_s))) {
      idle.waiting_s += sample.time_step_s;
      idle.charge_As += sample.current_A * sample.time_step_s;
      if (!busy || idle.waiting_s > T(idle_patience_s)) {
        Sample<T> mean = sample;
        mean.time_step_s = idle.waiting_s;
        mean.current_A = idle.waiting_s > T(0) ? idle.charge_As / idle.waiting_s : sample.current_A;
        magnetise(valve.actuator, idle.actuator, mean);
        widen_flux_range(idle.actuator);
        idle.waiting_s = idle.charge_As = T(0);
      }
      if (busy || begins) {
        idle.magnetic_force_N =
            valve.actuator.magnetic_force.at(idle.actuator.coil.magnetising_current_A, sample.position_m).value;
      }
    }
  }
}

/// Both coils silent and the spool at rest near zero: the springs have centred it.
template <class T>
constexpr void follow_zero(WholeValveState<T>& state, const PositionPoint<T>& position, bool silent, T time_step_s) {
  const bool centred = silent && position.motion == Motion::rest && magnitude(position.position_m) < T(centring_m);
  state.centred_s = centred ? state.centred_s + time_step_s : T(0);
  if (!(state.centred_s < T(centring_rest_s)))
    state.zero_m += position.position_m * smaller(time_step_s / T(zero_following_s), T(1));
}

/// Where no pressures are measured. A pressure difference at the end of what was calibrated may be of a load that helps
/// the supply.
template <class T>
constexpr void mark_ambiguous_load(const ObserverParameters<T>& valve, ObserverState<T>& state, T position_m) {
  const bool capped = is_capped(state.pressure, valve.highest_pressure_difference_Pa());
  mark(state.last.status, capped && !(position_m < valve.closed_below_m), Status::ambiguous_load);
}

/// The observer of the open side, with measured port pressures where they are.
template <class T>
SPOOLFLOW_INLINE constexpr void observe_path(const ObserverParameters<T>& valve, WholeValveState<T>& state,
                                             const WholeValveSample<T>& sample, const Sample<T>& own,
                                             const PositionPoint<T>& position, const Dither<T>& dither,
                                             const Schedule<T>& schedule, bool opens_a) {
  const bool ports_measured = measured(sample.ports);
  if (ports_measured) use_measured(valve, state.open.pressure, path_drops(sample.ports, opens_a));
  observe(valve, state.open, own, position, dither, schedule, state.idle.magnetic_force_N);
  if (ports_measured) {
    const PathDrops<T> drops = path_drops(sample.ports, opens_a);
    use_measured(valve, state.open.pressure, drops);
    follow_share(valve.inlet, state.inlet_share, drops, sample.time_step_s);
    answer_measured(valve, {drops, state.inlet_share}, {state.open.oil_layer, position.position_m}, state.open.last);
  } else {
    mark_ambiguous_load(valve, state.open, position.position_m);
    widen_unsettled(valve.unsettled_load_share, state.settled_m3_per_s, sample.time_step_s, state.open.last);
  }
}

/// The chain of the side on which the spool stands; one valve calls it with either side written out: with its tables'
/// addresses a compiler knows their numbers. `position` is in the valve's signs.
template <class T>
SPOOLFLOW_INLINE constexpr void observe_side(bool opens_a, const Sides<T>& now, WholeValveState<T>& state,
                                             const WholeValveSample<T>& sample,
                                             const PositionSensor<T>& position_sensor, PositionPoint<T> position,
                                             const Dither<T>& dither, const Schedule<T>& schedule, bool begins) {
  const Sample<T> own = sample_of(sample, opens_a);
  const Sample<T> other = sample_of(sample, !opens_a);
  const bool silent = magnitude(own.current_A) < T(quiet_current_share) * now.open.largest_current_A &&
                      magnitude(other.current_A) < T(quiet_current_share) * now.idle.largest_current_A;
  follow_zero(state, position, silent, sample.time_step_s);
  const bool near = magnitude(position.position_m) <
                    T(sign_margin_m) + T(sign_deviations) * position_sensor.noise_m + position_sensor.backlash_m;
  position = mirrored(opens_a, position);

  const bool busy = !begins && position.block.closed;
  follow_idle(now.idle, state.idle, other, begins, busy);
  observe_path(now.open, state, sample, own, position, dither, schedule, opens_a);
  state.open.last = mirrored(opens_a, state.open.last);
  mark(state.open.last.status, near && !(position.position_m < now.open.closed_below_m), Status::sign_undetermined);
}

/// The sample, or, in `held`, with the last credible current of each coil whose current leapt; see the same of one
/// direction.
template <class T>
SPOOLFLOW_INLINE constexpr const WholeValveSample<T>& credible(const WholeValveParameters<T>& valve,
                                                               WholeValveState<T>& state,
                                                               const WholeValveSample<T>& measured,
                                                               WholeValveSample<T>& held) {
  const Sides<T> now = sides(valve, state.opens_a);
  const bool opens_a = state.opens_a;
  const T open_A = state.open.position.coil.current_A, idle_A = state.idle.current_A, step_s = measured.time_step_s;
  const T last_m = state.open.position.last_m;
  const Sample<T> own = sample_of(measured, opens_a);
  const bool holds_open =
      is_held(now.open.current_limits, {open_A, own.current_A}, step_s, state.open.held_currents, [&](T fastest_A) {
        return possible_change_A(now.open, state.open, own, opens_a ? -last_m : last_m,
                                 measured.position_m - state.zero_m - last_m, fastest_A);
      });
  // Without current there is little flux that a motion could change; the voltage before is not kept.
  const bool holds_idle = is_held(now.idle.current_limits, {idle_A, sample_of(measured, !opens_a).current_A}, step_s,
                                  state.idle.held_currents, [](T fastest_A) { return fastest_A; });
  state.open.held_currents = held_in_a_row(state.open.held_currents, holds_open);
  state.idle.held_currents = held_in_a_row(state.idle.held_currents, holds_idle);
  if (likely(!holds_open && !holds_idle)) return measured;
  held = measured;
  if (holds_open) hold_current(held, opens_a, open_A);
  if (holds_idle) hold_current(held, !opens_a, idle_A);
  return held;
}

/// One more sample in which no force is used; see the same of one direction. On the other side of the centre nothing is
/// known of the pressure difference.
template <class T>
constexpr void widen_held(const WholeValveParameters<T>& valve, WholeValveState<T>& state,
                          const WholeValveSample<T>& sample) {
  const Sides<T> now = sides(valve, state.opens_a);
  const T time_step_s = sample.time_step_s;
  const bool seen = is_number(sample.position_m);
  const T measured_m =
      drift_free_m(valve.b->position_sensor, sample.position_m - state.zero_m, state.open.oil.temperature_K);
  if (seen) follow_unobserved(valve.b->position_sensor, state.open.position, measured_m, time_step_s);
  const T signed_m = seen ? measured_m : state.open.position.last_m;
  const T position_m = state.opens_a ? -signed_m : signed_m;
  Estimate<T> held = mirrored(state.opens_a, state.open.last);
  sensor::widen_held(now.open, {state.open.pressure, state.open.force_errors, state.open.oil_layer}, {position_m, seen},
                     time_step_s, held);

  const MeteringEdge<T>& other = now.idle.edge;
  const T highest_Pa = other.highest_pressure_difference_Pa();
  const T other_m = seen ? -position_m : other.position_m.at(edge_positions - 1);
  const T most =
      other.conductance_at(other.layer_at(state.open.oil.temperature_K).cell, highest_Pa, other_m) * sqrt(highest_Pa);
  if (!seen || position_m < T(0)) {
    open_band(held, {-most, T(0)}, seen, time_step_s);
  }
  state.idle.closed_s += smaller(time_step_s, T(longest_step_s));
  state.open.last = mirrored(state.opens_a, held);
}

}  // namespace detail

/// A sample that cannot be used; see the same of one direction.
template <class T>
SPOOLFLOW_NOINLINE constexpr void hold(const WholeValveParameters<T>& valve, WholeValveState<T>& state,
                                       const WholeValveSample<T>& sample) {
  const bool leapt = sample.time_step_s > T(longest_step_s);  // not where it is no number
  if (state.open.started && within(sample.time_step_s, T(endless_step_s))) detail::widen_held(valve, state, sample);
  state.open.started = state.open.started && !leapt;
  if (!state.open.started) open_band(state.open.last, {-most_flow(*valve.a), most_flow(*valve.b)}, true, T(0));
  state.open.last.status = unusable(sample) | when(leapt, Status::time_fault);
}

/// One sample of the whole valve. Needs both currents and the position, and a time that does not run backwards:
/// otherwise the last flow is held (`hold`). The answer, in the valve's signs, stays in the state.
template <class T>
constexpr const Estimate<T>& step(const WholeValveParameters<T>& valve, WholeValveState<T>& state,
                                  const WholeValveSample<T>& measured) {
  if (unusable(measured) != Status::none) {
    hold(valve, state, measured);
    return state.open.last;
  }
  const bool leapt = time_leapt(measured.time_step_s);
  const bool irregular = is_irregular(measured.time_step_s) && (state.open.started || !is_zero(measured.time_step_s));
  using detail::sides;
  const bool begins = !state.open.started || leapt;
  WholeValveSample<T> held;
  const WholeValveSample<T>& sample = begins ? measured : detail::credible(valve, state, measured, held);
  if (begins) detail::begin(valve, state, sample);
  const PositionSensor<T>& position_sensor = valve.b->position_sensor;
  const Sample<T> own = sample_of(sample, state.opens_a);

  // Where the spool is, in the valve's signs, and on which side of the centre.
  Sample<T> signed_sample = own;
  signed_sample.position_m = sample.position_m - state.zero_m;
  const ObserverParameters<T>& before = sides(valve, state.opens_a).open;
  const Dither<T> dither =
      follow_dither(state.open.dither, own.current_A, before.largest_current_A, sample.time_step_s);
  const PositionPoint<T> position =
      track(position_sensor, state.open.position, signed_sample, detail::quiet_coil(before), state.open.drift_m, dither,
            state.open.swing.frees, [&] { return elastic_m(before.friction, state.open.friction); });
  Schedule<T> schedule = detail::schedule_of(position.block);
  detail::follow_oil(position_sensor, state.open, own.oil_temperature_K, schedule.oil_temperature);
  const T from_centre_m = state.opens_a ? -position.position_m : position.position_m;
  const bool changes = from_centre_m < T(-centre_hysteresis_m);
  if (changes) {
    detail::change_sides(valve, state);
    state.open.position.coil.current_A = sample_of(sample, state.opens_a).current_A;
    schedule.force_uncertainty = schedule.slip_excess = true;  // they are those of the other solenoid
    schedule.oil_temperature.now = true;                       // its place is that in the other edge's tables
  }
  state.idle.current_A = sample_of(sample, !state.opens_a).current_A;

  const auto seen_from = [&](bool opens_a) SPOOLFLOW_INLINE_LAMBDA {
    detail::observe_side(opens_a, sides(valve, opens_a), state, sample, position_sensor, position, dither, schedule,
                         begins);
  };
  if (state.opens_a) {
    seen_from(true);
  } else {
    seen_from(false);
  }
  if (irregular) state.open.last.status |= Status::time_fault;
  if (unlikely(state.open.held_currents + state.idle.held_currents > 0))
    state.open.last.status |= Status::current_fault;
  return state.open.last;
}

}  // namespace spoolflow::sensor
