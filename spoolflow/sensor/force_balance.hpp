#pragma once
/// The forces on spool and armature at the estimated pressure difference: what they leave is friction, and what
/// friction cannot be is the innovation of the pressure difference. Paper (1) and section 3.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

/// What is known of the forces before friction.
template <class T>
struct AxialForces {
  const ActuatorEstimate<T>& actuator;  ///< what another solenoid holds against this one's is taken off
  T spring_N;
  const EdgePoint<T>& edge;  ///< at the estimated pressure difference
  T friction_ratio;          ///< friction in operation over the bench's, as estimated
};

/// What friction remembers.
template <class T>
struct FrictionMemory {
  FrictionState<T>& contacts;
  FrictionSwingState<T>& swing;
};

/// When the slow parts of friction run, and the sample's time step.
template <class T>
struct FrictionTiming {
  bool slip_excess;  ///< due
  Due<T> memory;
  T dither_period_s;
  T time_step_s;
};

/// Forces [N] of one sample. Signs: the magnetic force opens (+), spring and flow force close (+), friction has the
/// sign of the velocity.
template <class T>
struct ForceBalance {
  ActuatorEstimate<T> actuator;
  T spring_N;
  EdgePoint<T> edge;
  T residual_force_N;     ///< residual force: magnetic force less spring and flow force
  T spool_friction_N;     ///< of the spool while it slides, >= 0
  T armature_friction_N;  ///< of the armature while it slides, >= 0
  FrictionBounds<T> bounds;
  FrictionInterval<T> resting;  ///< where friction lies at rest
  T friction_N;                 ///< estimated
  T half_swing_N;               ///< of friction under dither, >= 0; all friction here is that of its middle
  T noise_N;                    ///< one standard deviation of all forces together
  T direction;                  ///< 1 opening, -1 closing; 0 at rest and where dither frees the spool
  bool dithered;
  bool freed;    ///< by dither, both ways in each period
  bool settled;  ///< a whole period of dither, or a sample without dither, is there to measure by
  bool sliding;
  bool slips;   ///< friction and inertia are in motion
  bool closed;  ///< the spool covers the metering edge
};

/// One standard deviation of all forces together [N], from that of each. `moving_N` is that of what motion that the
/// position shows late, or the swing under dither, may be wrong by.
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
  return {at_least_zero(bounds.sliding_N + excess_N - half_swing_N), at_least_zero(bounds.sticking_N - half_swing_N)};
}

/// What the mass of the slips asks for in each period of dither [N].
template <class T>
constexpr T slips_excess_N(const ObserverParameters<T>& valve, T half_swing_N, T period_s, T velocity_m_per_s) {
  const T stiffness_N_per_m = valve.friction.contact_stiffness_N_per_m;
  const T elastic_m = T(2) * half_swing_N / (lies_below(stiffness_N_per_m, T(1)) ? T(1) : stiffness_N_per_m);
  return slip_excess_N(valve.moving_mass_kg, half_swing_N, magnitude(velocity_m_per_s) * period_s - elastic_m,
                       period_s);
}

/// While the spool slides, friction that was there some milliseconds ago and now is less by more than this share of it
/// says that the spool stops or turns, before the position shows it.
inline constexpr double unshown_drop_share = 0.1;

/// What of friction has gone while the position still shows the spool slide [N], >= 0: the forces are no surer than
/// that. `earlier_N` is the residual force some milliseconds ago; what stuck then is no friction of sliding.
template <class T>
SPOOLFLOW_INLINE constexpr T unshown_drop_N(T sliding_N, T direction, T earlier_N, T now_N) {
  return at_least_zero(smaller(direction * earlier_N, sliding_N) - direction * now_N -
                       T(unshown_drop_share) * sliding_N);
}

namespace detail {

/// Friction over a period of dither, or at this sample, and its bounds.
template <class T>
SPOOLFLOW_INLINE constexpr void swing(const ObserverParameters<T>& valve, const FrictionMemory<T>& memory,
                                      const Dither<T>& dither, const PositionPoint<T>& position,
                                      const FrictionTiming<T>& timing, ForceBalance<T>& balance) {
  const FrictionSwing<T> swing = follow_swing(memory.swing, dither, balance.residual_force_N);
  balance.dithered = dither.present;
  // Where dither frees the spool altogether, no contact ages.
  balance.freed = dither.present && swing.half_swing_N > valve.friction.freeing_share * balance.bounds.sliding_N;
  balance.settled = swing.settled;
  balance.residual_force_N = swing.middle_N;
  balance.half_swing_N = swing.half_swing_N;
  memory.swing.frees = balance.freed;
  if (!dither.present) return;
  if (balance.freed) memory.contacts.rest_s = T(0);
  const bool moves = balance.freed || position.motion != Motion::rest;
  if (timing.slip_excess)
    memory.swing.excess_N =
        slips_excess_N(valve, swing.half_swing_N, timing.dither_period_s, position.velocity_m_per_s);
  balance.bounds = within_swing(balance.bounds, swing.half_swing_N, moves ? memory.swing.excess_N : T(0));
}

}  // namespace detail

/// The axial force balance of one sample; moves the memory of friction.
template <class T>
SPOOLFLOW_INLINE constexpr ForceBalance<T> balance_forces(const ObserverParameters<T>& valve,
                                                          const FrictionMemory<T>& memory, const AxialForces<T>& forces,
                                                          const PositionPoint<T>& position, const Dither<T>& dither,
                                                          const FrictionTiming<T>& timing) {
  ForceBalance<T> out;
  out.actuator = forces.actuator;
  out.spring_N = forces.spring_N;
  out.edge = forces.edge;
  const T net_N = forces.actuator.magnetic_force_N - forces.spring_N;  // carries flow force and friction; paper (1)
  out.spool_friction_N = forces.friction_ratio * forces.edge.friction_N;
  out.armature_friction_N = forces.friction_ratio * forces.actuator.friction_half_width_N;
  out.bounds = friction_bounds(valve.friction, memory.contacts, out.spool_friction_N, out.armature_friction_N);
  out.residual_force_N = net_N - forces.edge.flow_force_N;
  detail::swing(valve, memory, dither, position, timing, out);
  out.resting = step(valve.friction, memory.contacts, out.bounds, valve.position_sensor, position, out.residual_force_N,
                     out.dithered, timing.memory, timing.time_step_s);

  out.closed = position.position_m < valve.closed_below_m;
  const bool travels = slides(position.motion);
  out.sliding = travels || out.freed;
  out.slips = position.motion == Motion::transient && !out.freed;
  out.direction = travels || out.slips ? (position.travel_m > T(0) ? T(1) : T(-1)) : T(0);
  out.friction_N = out.sliding ? out.direction * out.bounds.sliding_N
                               : limited(out.residual_force_N, out.resting.lower_N, out.resting.upper_N);
  // Paper (1): the mass takes a part of the force; position shows it late, so that it is no surer than its size.
  T inertia_N{}, drop_N{};
  if (travels && !out.dithered) {
    inertia_N = valve.moving_mass_kg * position.acceleration_m_per_s2;
    drop_N = unshown_drop_N(out.bounds.sliding_N, out.direction, memory.contacts.earlier_N, out.residual_force_N);
  }
  out.residual_force_N -= inertia_N;
  const T missed_N = T(missed_middle) * squared(dither.sample_per_period) * out.half_swing_N;
  out.noise_N = force_noise_N(valve.band, out.actuator, out.bounds, out.dithered ? missed_N : inertia_N + drop_N);
  return out;
}

}  // namespace spoolflow::sensor
