#pragma once
/// What the plant is in at one instant, and what its surroundings do to it.
#include <optional>

#include "spoolflow/rig/hydraulics/oil.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"

namespace spoolflow::rig {

/// Where an external drive has spool or armature at the end of a step, and how fast; on the way there the position
/// follows the cubic through both ends' positions and velocities. The acceleration is for the load cell's inertia only.
struct PrescribedMotion {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double acceleration_m_per_s2 = 0.0;
};

/// What the surroundings do during one step.
struct PlantInput {
  double voltage_a_V = 0.0;  ///< over the winding's terminals, mean over the step
  double voltage_b_V = 0.0;
  double supply_pressure_Pa = 100e5;         ///< set value, gauge; all loads but the held difference
  double held_pressure_difference_Pa = 0.0;  ///< set value; load held_difference
  double load_force_N = 0.0;                 ///< on the cylinder, > 0 against moving out
  double oil_temperature_C = 50.0;           ///< at the supply
  double ambient_temperature_C = 25.0;
  std::optional<PrescribedMotion> motion;  ///< absent: spool moves freely
};

struct PlantState {
  double time_s = 0.0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  SolenoidState solenoid_a;
  SolenoidState solenoid_b;
  FrictionState spool_friction;
  OilState oil;  ///< at the last oil temperature
  double pressure_P_Pa = 0.0;
  double pressure_A_Pa = 0.0;
  double pressure_B_Pa = 0.0;
  double hold_flow_m3_per_s = 0.0;  ///< integrator of the bench's pressure controller
  double cylinder_position_m = 0.0;
  double cylinder_velocity_m_per_s = 0.0;
};

}  // namespace spoolflow::rig
