#pragma once
/// The solenoid as a force sensor: coil current, coil voltage and spool position give the magnetic force.
#include <type_traits>

#include "spoolflow/sensor/magnetic_force.hpp"
#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::sensor {

/// Everything about one solenoid that its force needs.
template <class T>
struct ActuatorParameters {
  MagneticForce<T> magnetic_force;  ///< averaged over both directions
  Map<T, force_map_currents, force_map_positions>
      friction_N;        ///< armature friction, half width, over current, position
  T force_residual_N{};  ///< standard deviation of the measured force about the map
};

/// What the solenoid remembers between samples; {} is a demagnetised coil at rest.
template <class T>
struct ActuatorState {
  T current_A{};  ///< last finite current
  bool started{};
};

/// What the solenoid answers.
template <class T>
struct ActuatorEstimate {
  T magnetic_force_N{};       ///< opening > 0, without armature friction
  T uncertainty_N{};          ///< one standard deviation of the magnetic force
  T friction_half_width_N{};  ///< armature friction while it slides, >= 0; its sign is that of the velocity
  T force_per_current_N_per_A{};
  T force_per_position_N_per_m{};  ///< what an error of the position means for the force
  bool inside_map{};               ///< current and position lie within what was calibrated
};

static_assert(std::is_trivially_copyable_v<ActuatorParameters<float>>);
static_assert(std::is_trivially_copyable_v<ActuatorState<float>>);

/// One sample. `position_m` is the position to be believed: faults and drift are removed before. Current and position
/// must be finite; a voltage that is NaN is one that is not measured. Any time step from 50 us to 5 ms.
template <class T>
constexpr ActuatorEstimate<T> step(const ActuatorParameters<T>& actuator, ActuatorState<T>& state,
                                   const Sample<T>& sample) {
  using std::sqrt;
  state.current_A = sample.current_A;
  state.started = true;
  const Cell<T> current = locate<force_map_currents>(actuator.magnetic_force.map.row_axis, sample.current_A);
  const Cell<T> position = locate<force_map_positions>(actuator.magnetic_force.map.column_axis, sample.position_m);
  const MapPoint<T> force = actuator.magnetic_force.map.at(current, position);
  const T half_width_N = actuator.magnetic_force.hysteresis_half_width_N.at(sample.current_A).value;
  return {force.value,
          sqrt(squared(actuator.force_residual_N) + squared(half_width_N)),
          actuator.friction_N.at(current, position).value,
          force.row_slope,
          force.column_slope,
          force.inside};
}

}  // namespace spoolflow::sensor
