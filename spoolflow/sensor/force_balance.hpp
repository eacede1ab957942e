#pragma once
/// The forces on spool and armature at the believed pressure difference: what they leave is friction, and what friction
/// cannot be is the innovation of the pressure difference. Paper (1) and section 3.
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
  T noise_N;                    ///< one standard deviation of all forces together
  T direction;                  ///< 1 opening, -1 closing: of the motion or of the last
  Mask<T> sliding;
  Mask<T> closed;  ///< the spool covers the metering edge
};

/// One standard deviation of all forces together [N], as the parts tell it.
template <class T>
[[gnu::always_inline]] constexpr T force_noise_N(const BandParameters<T>& band, const ActuatorEstimate<T>& actuator,
                                                 const FrictionBounds<T>& bounds) {
  return sqrt(squared(band.force_residual_N) + squared(actuator.uncertainty_N) +
              squared(band.friction_share * bounds.sliding_N));
}

/// From coil current and position to friction; moves the memory of solenoid and friction. `begins` at the first sample.
template <class T>
[[gnu::always_inline]] constexpr ForceBalance<T> balance_forces(const ObserverParameters<T>& valve,
                                                                ObserverState<T>& state, const Sample<T>& sample,
                                                                const PositionPoint<T>& position, Mask<T> begins) {
  Sample<T> actuated = sample;
  actuated.position_m = position.position_m;
  ForceBalance<T> out;
  out.actuator = step(valve.actuator, state.actuator, actuated, begins);
  out.spring_N = valve.spring.at(position.position_m).value;
  const T net_N = out.actuator.magnetic_force_N - out.spring_N;  // carries flow force and friction; paper (1)

  const PressureState<T>& pressure = state.pressure;
  out.edge = valve.edge.at(state.oil_temperature_K, pressure.pressure_difference_Pa, position.position_m);
  out.spool_friction_N = pressure.friction_ratio * out.edge.friction_N;
  out.armature_friction_N = pressure.friction_ratio * out.actuator.friction_half_width_N;
  out.bounds = friction_bounds(valve.friction, state.friction, out.spool_friction_N, out.armature_friction_N);
  out.apparent_friction_N = net_N - out.edge.flow_force_N;
  out.resting = step(valve.friction, state.friction, out.bounds, valve.position_sensor, position,
                     out.apparent_friction_N, sample.time_step_s);

  out.closed = position.position_m < valve.closed_below_m;
  out.sliding = is(position.motion, Motion::opening) || is(position.motion, Motion::closing);
  out.direction = select(position.travel_m > T(0), T(1), T(-1));
  out.friction_N = select(out.sliding, out.direction * out.bounds.sliding_N,
                          limited(out.apparent_friction_N, out.resting.lower_N, out.resting.upper_N));
  out.noise_N = force_noise_N(valve.band, out.actuator, out.bounds);
  return out;
}

}  // namespace spoolflow::sensor
