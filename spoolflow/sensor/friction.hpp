#pragma once
/// Friction of spool and armature: known while they slide, bounded while they stick, and told there by the micrometres
/// by which the contact gives way (pre-sliding).
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/position_track.hpp"
#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// What the bench's half widths do not tell. See paper section 2.1.3; pre-sliding after Dahl.
template <class T>
struct FrictionParameters {
  T stiction_ratio{};             ///< largest friction at rest over sliding friction of the spool, >= 1
  T contact_stiffness_N_per_m{};  ///< of the contacts in pre-sliding
  T gauge_tolerance_ratio{};      ///< how far the pre-sliding displacement may mislead, as a share of sliding friction
  T gauge_tolerance_N{};          ///< and regardless of it
};

template <class T>
struct FrictionState {
  T gauge_N{};     ///< friction by the pre-sliding displacement, sign of the velocity
  T smooth_m{};    ///< position, smoothed over some milliseconds
  T followed_m{};  ///< the same without what noise may fake
  bool started{};
};

/// Friction lies between these; > 0 hinders opening.
template <class T>
struct FrictionInterval {
  T lower_N;
  T upper_N;
};

/// What bounds friction at this sample.
template <class T>
struct FrictionBounds {
  T sliding_N;   ///< of spool and armature together while they slide
  T sticking_N;  ///< the most that they can hold at rest
};

template <class T>
constexpr FrictionBounds<T> friction_bounds(const FrictionParameters<T>& friction, T spool_N, T armature_N) {
  return {spool_N + armature_N, friction.stiction_ratio * spool_N + armature_N + friction.gauge_tolerance_N};
}

/// Follows the pre-sliding displacement. `apparent_N` is the friction that the believed pressure difference leaves;
/// while the spool slips it is all there is, and slowly the gauge returns to it. Returns where friction may lie at
/// rest.
template <class T>
constexpr FrictionInterval<T> step(const FrictionParameters<T>& friction, FrictionState<T>& state,
                                   const FrictionBounds<T>& bounds, const PositionSensor<T>& sensor,
                                   const PositionPoint<T>& position, T apparent_N, T time_step_s) {
  using std::sqrt;
  if (!state.started) {
    state.started = true;
    state.smooth_m = state.followed_m = position.position_m;
  }
  constexpr T smoothing_s = T(0.01);
  constexpr T forgetting_s = T(1);
  const T time_constant_s = position.motion == Motion::transient ? T(0.2) * smoothing_s : smoothing_s;
  const T share = time_step_s / (time_constant_s + time_step_s);
  state.smooth_m += share * (position.position_m - state.smooth_m);
  const T slack_m = sensor.noise_m * sqrt(T(0.5) * share);  // one standard deviation of the smoothed position
  const T before_m = state.followed_m;
  state.followed_m = limited(state.followed_m, state.smooth_m - slack_m, state.smooth_m + slack_m);
  const T moved_m = state.followed_m - before_m;

  const T holds_N = bounds.sticking_N;
  const T sign = select(moved_m < T(0), T(-1), T(1));
  const T reserve = larger(T(1) - sign * state.gauge_N / holds_N, T(0));
  state.gauge_N += friction.contact_stiffness_N_per_m * moved_m * reserve;  // Dahl: stiffness fades towards the limit
  state.gauge_N = limited(state.gauge_N, -holds_N, holds_N);
  if (position.motion == Motion::opening) {
    state.gauge_N = bounds.sliding_N;
  } else if (position.motion == Motion::closing) {
    state.gauge_N = -bounds.sliding_N;
  } else if (position.motion == Motion::transient) {
    state.gauge_N = limited(apparent_N, -holds_N, holds_N);
  } else {
    state.gauge_N +=
        (limited(apparent_N, -holds_N, holds_N) - state.gauge_N) * smaller(time_step_s / forgetting_s, T(1));
  }
  const T tolerance_N = friction.gauge_tolerance_ratio * bounds.sliding_N + friction.gauge_tolerance_N;
  return {limited(state.gauge_N - tolerance_N, -holds_N, holds_N),
          limited(state.gauge_N + tolerance_N, -holds_N, holds_N)};
}

static_assert(std::is_trivially_copyable_v<FrictionState<float>>);

}  // namespace spoolflow::sensor
