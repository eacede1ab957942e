#pragma once
/// The same valve seen from its other end: what opens to one side closes to the other.
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/friction.hpp"
#include "spoolflow/sensor/signals/position_track.hpp"

namespace spoolflow::sensor {

/// As side a sees it, where it is `seen_from_a`.
template <class T>
constexpr PositionPoint<T> mirrored(bool seen_from_a, PositionPoint<T> point) {
  if (!seen_from_a) return point;
  if (point.motion == Motion::opening) {
    point.motion = Motion::closing;
  } else if (point.motion == Motion::closing) {
    point.motion = Motion::opening;
  }
  point.position_m = -point.position_m;
  point.travel_m = -point.travel_m;
  point.velocity_m_per_s = -point.velocity_m_per_s;
  point.acceleration_m_per_s2 = -point.acceleration_m_per_s2;
  point.side = -point.side;
  return point;
}

/// What the contacts remember.
template <class T>
constexpr void mirror(FrictionState<T>& state) {
  state.presliding_N = -state.presliding_N;
  state.smooth_m = -state.smooth_m;
  state.followed_m = -state.followed_m;
  state.engaged_m = -state.engaged_m;
  state.engagement = -state.engagement;
  state.held_N = -state.held_N;
  state.earlier_N = -state.earlier_N;
}

/// Flow and forces; the pressure difference stays that of the open path.
template <class T>
constexpr Estimate<T> mirrored(bool seen_from_a, const Estimate<T>& estimate) {
  const auto turned = [&](T value) { return seen_from_a ? -value : value; };
  Estimate<T> out = estimate;
  out.flow_m3_per_s = turned(estimate.flow_m3_per_s);
  out.flow_lower_m3_per_s = seen_from_a ? -estimate.flow_upper_m3_per_s : estimate.flow_lower_m3_per_s;
  out.flow_upper_m3_per_s = seen_from_a ? -estimate.flow_lower_m3_per_s : estimate.flow_upper_m3_per_s;
  out.magnetic_force_N = turned(estimate.magnetic_force_N);
  out.spring_force_N = turned(estimate.spring_force_N);
  out.flow_force_N = turned(estimate.flow_force_N);
  out.friction_force_N = turned(estimate.friction_force_N);
  return out;
}

}  // namespace spoolflow::sensor
