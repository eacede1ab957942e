#pragma once
/// The forces on spool and armature at the believed pressure difference: what they leave is friction, and what friction
/// cannot be is the innovation of the pressure difference. Paper (1) and section 3.
#include "spoolflow/sensor/compiler.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

/// Forces [N] of one sample. Signs: the magnetic force opens (+), spring and flow force close (+), friction has the
/// sign of the velocity.
template <class T>
struct ForceBalance {
  ActuatorEstimate<T> actuator;
  T spring_N;
  EdgePoint<T> edge;
  T apparent_friction_N;  ///< magnetic force less spring and flow force: what friction would have to be
  T spool_friction_N;     ///< of the spool while it slides, >= 0
  T armature_friction_N;  ///< of the armature while it slides, >= 0
  FrictionBounds<T> bounds;
  FrictionInterval<T> resting;  ///< where friction lies at rest
  T friction_N;                 ///< believed
  T half_swing_N;               ///< of friction under dither, >= 0; all friction here is that of its middle
  T noise_N;                    ///< one standard deviation of all forces together
  T direction;                  ///< 1 opening, -1 closing: of the motion or of the last
  bool dithered;
  bool freed;    ///< by dither, both ways in each period
  bool settled;  ///< a whole period of dither tells, or a sample without dither
  bool sliding;
  bool slips;   ///< friction and inertia are in motion
  bool closed;  ///< the spool covers the metering edge
};

/// One standard deviation of all forces together [N], as the parts tell it. `moving_N` is that of what inertia, or the
/// swing under dither, may be wrong by.
template <class T>
SPOOLFLOW_INLINE constexpr T force_noise_N(const BandParameters<T>& band, const ActuatorEstimate<T>& actuator,
                                           const FrictionBounds<T>& bounds, T moving_N) {
  return sqrt(squared(moving_N) + squared(band.force_residual_N) + squared(actuator.uncertainty_N) +
              squared(band.friction_share * bounds.sliding_N));
}

/// Dither takes half the swing of friction off its limits, and where it moves the spool adds what the slips' mass asks
/// for.
template <class T>
constexpr FrictionBounds<T> within_swing(const FrictionBounds<T>& bounds, T half_swing_N, T excess_N) {
  return {larger(bounds.sliding_N + excess_N - half_swing_N, T(0)), larger(bounds.sticking_N - half_swing_N, T(0))};
}

/// What the mass of the slips asks for in each period of dither [N].
template <class T>
constexpr T slips_excess_N(const ObserverParameters<T>& valve, T half_swing_N, T period_s, T velocity_m_per_s) {
  const T elastic_m = T(2) * half_swing_N / larger(valve.friction.contact_stiffness_N_per_m, T(1));
  return slip_excess_N(valve.moving_mass_kg, half_swing_N, magnitude(velocity_m_per_s) * period_s - elastic_m,
                       period_s);
}

/// Friction over a period of dither, or at this sample, and its bounds.
template <class T>
SPOOLFLOW_INLINE constexpr void swing(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                      const Dither<T>& dither, const PositionPoint<T>& position,
                                      ForceBalance<T>& balance) {
  const FrictionSwing<T> swing = follow_swing(state.swing, dither, balance.apparent_friction_N);
  balance.dithered = dither.present;
  // Where dither frees the spool altogether, no contact grows old.
  balance.freed = dither.present && swing.half_swing_N > valve.friction.freeing_share * balance.bounds.sliding_N;
  balance.settled = swing.settled;
  balance.apparent_friction_N = swing.middle_N;
  balance.half_swing_N = swing.half_swing_N;
  state.swing.frees = balance.freed;
  if (!dither.present) return;
  if (balance.freed) state.friction.rest_s = T(0);
  const bool moves = balance.freed || position.motion != Motion::rest;
  if (position.turn.odd)
    state.swing.excess_N = slips_excess_N(valve, swing.half_swing_N, state.dither.period_s, position.velocity_m_per_s);
  balance.bounds = within_swing(balance.bounds, swing.half_swing_N, moves ? state.swing.excess_N : T(0));
}

/// From coil current and position to friction; moves the memory of solenoid and friction. `opposing_N` is what another
/// solenoid holds against this one's; `begins` at the first sample.
template <class T>
SPOOLFLOW_INLINE constexpr ForceBalance<T> balance_forces(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                                          const Sample<T>& sample, const PositionPoint<T>& position,
                                                          const Dither<T>& dither, T opposing_N, bool begins) {
  ForceBalance<T> out;
  out.actuator =
      step(valve.actuator, state.actuator, Sample<T>{sample.time_step_s, sample.current_A, {}, position.position_m, {}},
           begins, position.turn.odd);
  out.actuator.magnetic_force_N -= opposing_N;
  out.spring_N = valve.spring.at(position.position_m).value;
  const T net_N = out.actuator.magnetic_force_N - out.spring_N;  // carries flow force and friction; paper (1)

  const PressureState<T>& pressure = state.pressure;
  out.edge = valve.edge.at(state.oil_temperature_K, pressure.pressure_difference_Pa, position.position_m);
  out.spool_friction_N = pressure.friction_ratio * out.edge.friction_N;
  out.armature_friction_N = pressure.friction_ratio * out.actuator.friction_half_width_N;
  out.bounds = friction_bounds(valve.friction, state.friction, out.spool_friction_N, out.armature_friction_N);
  out.apparent_friction_N = net_N - out.edge.flow_force_N;
  swing(valve, state, dither, position, out);
  out.resting = step(valve.friction, state.friction, out.bounds, valve.position_sensor, position,
                     out.apparent_friction_N, out.dithered, sample.time_step_s);

  out.closed = position.position_m < valve.closed_below_m;
  const bool travels = position.motion == Motion::opening || position.motion == Motion::closing;
  out.sliding = travels || out.freed;
  out.slips = position.motion == Motion::transient && !out.freed;
  out.direction = travels || !out.freed ? (position.travel_m > T(0) ? T(1) : T(-1)) : T(0);
  out.friction_N = out.sliding ? out.direction * out.bounds.sliding_N
                               : limited(out.apparent_friction_N, out.resting.lower_N, out.resting.upper_N);
  // Paper (1): the mass takes a part of the force; position tells it late, so that it is no surer than its size.
  const T inertia_N = travels && !out.dithered ? valve.moving_mass_kg * position.acceleration_m_per_s2 : T(0);
  out.apparent_friction_N -= inertia_N;
  const T missed_N = T(missed_middle) * squared(dither.sample_per_period) * out.half_swing_N;
  out.noise_N = force_noise_N(valve.band, out.actuator, out.bounds, out.dithered ? missed_N : inertia_N);
  return out;
}

}  // namespace spoolflow::sensor
