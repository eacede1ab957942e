#pragma once
/// Friction of spool and armature: known while they slide, bounded while they stick, and estimated there from the
/// micrometres by which the contact gives way (pre-sliding).
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/due.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"
#include "spoolflow/sensor/signals/position_track.hpp"

namespace spoolflow::sensor {

/// What the bench's half-widths do not include. See paper section 2.1.3; pre-sliding after Dahl.
template <class T>
struct FrictionParameters {
  T ageing_ratio{};               ///< the spool's friction after a long rest over its sliding friction, >= 1
  T ageing_s{};                   ///< time constant of that growth
  T contact_stiffness_N_per_m{};  ///< of the contacts in pre-sliding
  T tolerance_N{};                ///< standard deviation of friction estimated from the pre-sliding displacement
  T breakaway_share{};            ///< standard deviation of the break-away force about ageing, as a share of it
  T operation_ratio{};            ///< friction in operation over half the width of the bench's loops, to begin with
  T freeing_share = T(1.2);       ///< dither frees the spool where half the swing of friction is so many times sliding
                                  ///< friction: contacts that hold for a moment in each period are not freed
};

template <class T>
struct FrictionState {
  T presliding_N{};  ///< middle of where friction may lie by the pre-sliding displacement, sign of the velocity
  T smooth_m{};      ///< position, smoothed
  T followed_m{};    ///< the same without what noise may fake
  T engaged_m{};     ///< how far the spool has moved the sensor one way, backlash engaged
  T engagement{};    ///< how sure that it is engaged, sign of the way, -1 to 1
  T rest_s{};        ///< since the spool came to rest
  T held_N{};        ///< friction as it was some milliseconds ago
  T earlier_N{};     ///< and some before
  T held_s{};
  T deadband_m{};  ///< deadband of the displacement: what noise may fake
};

/// Friction lies between these; > 0 hinders opening.
template <class T>
struct FrictionInterval {
  T lower_N;
  T upper_N;
  T breakaway_N;  ///< friction at the moment at which the spool broke away; 0 where it did not
  T rested_s;     ///< how long it had rested before
};

/// Smoothing of the position for pre-sliding friction [s].
inline constexpr double presliding_smoothing_s = 0.03;
/// Standard deviations of the smoothed position's noise that count as no motion.
inline constexpr double presliding_deadband_deviations = 2;
/// An engagement of the backlash by so many deadbands is as likely as not noise's.
inline constexpr double doubtful_engagement_deadbands = 0.7;
/// For so long [s] after it engaged it is known at which end of its backlash the sensor lies.
inline constexpr double engagement_memory_s = 0.02;
/// Share of the half-width on the other side of the estimate that is excluded where the backlash surely engages.
inline constexpr double engagement_certainty = 0.8;
/// What is left of the contact's stiffness at the limit of sticking, as a share of it.
inline constexpr double least_stiffness_share = 0.1;
/// Contacts whose pre-sliding displacement goes on beyond their limit by this length [m] have lost half of their age;
/// critical slip distance of Dieterich (1979), 1 to 20 um on metal.
inline constexpr double contact_memory_m = 8e-6;
/// Standard deviations of pre-sliding friction by which friction at rest may exceed the sticking limit.
inline constexpr double sticking_limit_deviations = 2;
/// The time at rest divides [s].
inline constexpr double least_rest_s = 1e-9;
/// For so long [s] after the first sample no break-away counts: how long the spool had rested before is not known.
inline constexpr double unknown_rest_s = 1;
/// A break-away shows in the position so much later [s]: the friction before it is what counts.
inline constexpr double breakaway_delay_s = 0.004;

/// What bounds friction at this sample.
template <class T>
struct FrictionBounds {
  T sliding_N;   ///< of spool and armature together while they slide
  T sticking_N;  ///< the most that they can hold after this rest
};

/// Contacts grow stronger while they rest.
template <class T>
constexpr T ageing(const FrictionParameters<T>& friction, T rest_s) {
  const T share = rest_s / (friction.ageing_s + rest_s);  // a rational rise: no exponential in the valve
  return T(1) + (friction.ageing_ratio - T(1)) * share;
}

template <class T>
constexpr FrictionBounds<T> friction_bounds(const FrictionParameters<T>& friction, const FrictionState<T>& state,
                                            T spool_N, T armature_N) {
  return {spool_N + armature_N, ageing(friction, state.rest_s) * spool_N + armature_N};
}

/// By how much noise may fake a displacement at rest.
template <class T>
SPOOLFLOW_INLINE constexpr T presliding_deadband_m(T noise_m, T time_step_s) {
  const T smoothing_s = T(presliding_smoothing_s);
  return T(presliding_deadband_deviations) * noise_m * sqrt(T(0.5) * time_step_s / (smoothing_s + time_step_s));
}

/// How far to either side of its estimate from the pre-sliding displacement friction may lie.
template <class T>
SPOOLFLOW_INLINE constexpr T presliding_half_width_N(const FrictionParameters<T>& friction,
                                                     const PositionSensor<T>& sensor, T deadband_m) {
  return friction.contact_stiffness_N_per_m * (sensor.backlash_m + deadband_m);
}

/// How far the contacts give way elastically under what they held some milliseconds ago [m]; endless without stiffness.
template <class T>
SPOOLFLOW_INLINE constexpr T elastic_m(const FrictionParameters<T>& friction, const FrictionState<T>& state) {
  return magnitude(state.held_N) / friction.contact_stiffness_N_per_m;
}

/// To be called before the first sample, with its position: how long the spool has been at rest is not known.
template <class T>
constexpr void begin(const FrictionParameters<T>& friction, FrictionState<T>& state, T position_m) {
  state.smooth_m = state.followed_m = position_m;
  state.presliding_N = state.engaged_m = state.engagement = state.held_N = state.earlier_N = T(0);
  state.held_s = T(-unknown_rest_s);
  state.rest_s = friction.ageing_s;
}

namespace detail {

/// What friction is estimated from while the spool rests.
template <class T>
struct Contact {
  T residual_N;    ///< residual force at the estimated pressure difference
  T sticking_N;    ///< the most that the contacts hold
  T holds_N;       ///< the same, and what the estimate may be wrong by
  T deadband_m;    ///< what noise may fake
  T half_width_N;  ///< how far friction may lie from the estimate
  bool creeps;
};

/// The spool moves the sensor along, which engages the backlash that way.
template <class T>
SPOOLFLOW_INLINE constexpr void engage(FrictionState<T>& state, T moved_m, T deadband_m) {
  const bool goes_on = !(moved_m * state.engaged_m < T(0));
  state.engaged_m = moved_m + (goes_on ? state.engaged_m : T(0));
  const T signed2 = state.engaged_m * magnitude(state.engaged_m);
  const T doubtful2 = squared(T(doubtful_engagement_deadbands) * deadband_m);
  state.engagement = signed2 / larger(magnitude(signed2) + doubtful2, T(1e-30));
}

/// Without displacement it is less and less known at which end of its backlash the sensor lies.
template <class T>
SPOOLFLOW_INLINE constexpr void forget_engagement(FrictionState<T>& state, T time_step_s) {
  state.engagement *= at_least_zero(T(1) - time_step_s * T(1 / engagement_memory_s));
}

/// The contacts give way. Dahl: stiffness fades towards the limit.
template <class T>
SPOOLFLOW_INLINE constexpr void displace(const FrictionParameters<T>& friction, FrictionState<T>& state,
                                         const Contact<T>& contact, T moved_m) {
  const T sign = moved_m < T(0) ? T(-1) : T(1);
  const T reserve = limited(T(1) - sign * contact.residual_N / contact.holds_N, T(least_stiffness_share), T(1));
  state.presliding_N += friction.contact_stiffness_N_per_m * moved_m * reserve;
  if (!contact.creeps) engage(state, moved_m, contact.deadband_m);
}

/// At rest: friction changes with the pre-sliding displacement, beyond what noise may fake: with few samples.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_displacement(const FrictionParameters<T>& friction, FrictionState<T>& state,
                                                    const Contact<T>& contact, T position_m, T time_step_s) {
  state.rest_s += time_step_s;
  const T smoothing_s = T(presliding_smoothing_s) + time_step_s;
  const T averaged_s = likely(smoothing_s < state.rest_s) ? smoothing_s : larger(state.rest_s, T(least_rest_s));
  state.smooth_m += time_step_s / averaged_s * (position_m - state.smooth_m);
  const T before_m = state.followed_m;
  const T least_m = state.smooth_m - contact.deadband_m, most_m = state.smooth_m + contact.deadband_m;
  if (before_m < least_m || most_m < before_m) {
    state.followed_m = before_m < least_m ? least_m : most_m;
    displace(friction, state, contact, state.followed_m - before_m);
  } else if (!contact.creeps) {
    forget_engagement(state, time_step_s);
  }
  // A spool that moves the sensor is at that end of its backlash, and holds no more than the contact bears; beyond that
  // it creeps, which makes the contacts young again.
  const T most_N = at_least_zero(contact.sticking_N - contact.half_width_N);
  const T beyond_N = magnitude(state.presliding_N) - most_N;
  if (unlikely(beyond_N > T(0))) {
    const T memory_N = T(contact_memory_m) * friction.contact_stiffness_N_per_m;
    state.rest_s *= memory_N / (memory_N + beyond_N);
    state.presliding_N = limited_size(state.presliding_N, most_N);
  }
}

/// In motion: friction is that of sliding, or in a slip what the forces leave; from there the next rest begins.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_motion(FrictionState<T>& state, const Contact<T>& contact, T sliding_N,
                                              const PositionPoint<T>& position) {
  const T direction = position.travel_m > T(0) ? T(1) : T(-1);
  const bool sliding = slides(position.motion);
  const T friction_N =
      (sliding ? direction * sliding_N : limited(contact.residual_N, -contact.holds_N, contact.holds_N));
  state.presliding_N = sliding ? friction_N - direction * contact.half_width_N : friction_N;
  state.smooth_m = position.position_m;
  state.followed_m = position.position_m - direction * contact.deadband_m;
  state.rest_s = T(0);
  state.engaged_m = state.engagement = T(0);
}

/// Keeps what friction was `breakaway_delay_s` ago and before.
template <class T>
SPOOLFLOW_INLINE constexpr void hold(FrictionState<T>& state, T residual_N, T time_step_s) {
  state.held_s += time_step_s;
  const bool delayed = state.held_s > T(breakaway_delay_s) - T(0.5) * time_step_s;  // no matter how the sum rounds
  if (!delayed) return;
  state.held_s = T(0);
  state.earlier_N = state.held_N;
  state.held_N = residual_N;
}

}  // namespace detail

/// Follows the pre-sliding displacement. `residual_N` is the residual force at the estimated pressure
/// difference; while the spool slips it is all there is. Where contacts creep, as dither lets them, the position shows
/// no friction. `memory` is due once a block of positions. Returns where friction may lie at rest.
template <class T>
SPOOLFLOW_INLINE constexpr FrictionInterval<T> step(const FrictionParameters<T>& friction, FrictionState<T>& state,
                                                    const FrictionBounds<T>& bounds, const PositionSensor<T>& sensor,
                                                    const PositionPoint<T>& position, T residual_N, bool creeps,
                                                    const Due<T>& memory, T time_step_s) {
  if (memory.now) state.deadband_m = presliding_deadband_m(sensor.noise_m * position.noise_times, time_step_s);
  const T deadband_m = state.deadband_m;
  const T half_width_N = presliding_half_width_N(friction, sensor, deadband_m);
  const T holds_N = bounds.sticking_N + T(sticking_limit_deviations) * friction.tolerance_N;
  const detail::Contact<T> contact{residual_N, bounds.sticking_N, holds_N, deadband_m, half_width_N, creeps};
  const T rested_s = state.rest_s;
  T breakaway_N{};
  if (likely(position.motion == Motion::rest)) {
    detail::follow_displacement(friction, state, contact, position.position_m, time_step_s);
  } else {
    if (rested_s > T(0)) {
      const T direction = position.travel_m > T(0) ? T(1) : T(-1);
      breakaway_N = direction * larger(direction * state.held_N, direction * state.earlier_N);
    }
    detail::follow_motion(state, contact, bounds.sliding_N, position);
  }
  if (memory.now) detail::hold(state, residual_N, memory.since_s());
  FrictionInterval<T> out{-bounds.sticking_N, bounds.sticking_N, breakaway_N, rested_s};
  if (creeps || slides(position.motion)) return out;
  // Friction lies on the side of the estimate to which the backlash engages.
  const T engaged_N = T(engagement_certainty) * half_width_N * state.engagement;
  const T below_N = engaged_N > T(0) ? half_width_N - engaged_N : half_width_N;
  const T above_N = engaged_N > T(0) ? half_width_N : half_width_N + engaged_N;
  out.lower_N = larger(state.presliding_N - below_N, -holds_N);
  out.upper_N = smaller(state.presliding_N + above_N, holds_N);
  return out;
}

static_assert(std::is_trivially_copyable_v<FrictionState<float>>);

}  // namespace spoolflow::sensor
