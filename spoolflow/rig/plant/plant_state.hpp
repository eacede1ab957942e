#pragma once
/// What the plant is in at one instant, and what its surroundings do to it.
#include <optional>

#include "spoolflow/rig/hydraulics/oil.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"

namespace spoolflow::rig {

/// Where an external drive has spool or armature at the end of a step, and how fast; on the way there the position
/// follows the cubic through both ends' positions and velocities. The acceleration is for the load cell's inertia only.
template <class Scalar>
struct PrescribedMotionOf {
  Scalar position_m = 0.0;
  Scalar velocity_m_per_s = 0.0;
  Scalar acceleration_m_per_s2 = 0.0;
};
using PrescribedMotion = PrescribedMotionOf<double>;

/// What the surroundings do during one step.
template <class Scalar>
struct PlantInputOf {
  Scalar voltage_a_V = 0.0;  ///< over the winding's terminals, mean over the step
  Scalar voltage_b_V = 0.0;
  Scalar supply_pressure_Pa = 100e5;         ///< set value, gauge; all loads but the held difference
  Scalar held_pressure_difference_Pa = 0.0;  ///< set value; load held_difference
  Scalar load_force_N = 0.0;                 ///< on the cylinder, > 0 against moving out
  Scalar foreign_force_N = 0.0;              ///< on spool and armatures towards +x, from outside the valve
  Scalar oil_temperature_C = 50.0;           ///< at the supply
  Scalar ambient_temperature_C = 25.0;
  std::optional<PrescribedMotionOf<Scalar>> motion;  ///< absent: spool moves freely
};
using PlantInput = PlantInputOf<double>;

template <class Scalar>
struct PlantStateOf {
  Scalar time_s = 0.0;
  Scalar position_m = 0.0;
  Scalar velocity_m_per_s = 0.0;
  SolenoidStateOf<Scalar> solenoid_a;
  SolenoidStateOf<Scalar> solenoid_b;
  FrictionStateOf<Scalar> spool_friction;
  OilStateOf<Scalar> oil;  ///< at the last oil temperature
  Scalar pressure_P_Pa = 0.0;
  Scalar pressure_A_Pa = 0.0;
  Scalar pressure_B_Pa = 0.0;
  Scalar hold_flow_m3_per_s = 0.0;  ///< integrator of the bench's pressure controller
  Scalar cylinder_position_m = 0.0;
  Scalar cylinder_velocity_m_per_s = 0.0;
};
using PlantState = PlantStateOf<double>;

}  // namespace spoolflow::rig
