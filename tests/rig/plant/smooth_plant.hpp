#pragma once
/// The plant without what is not smooth, and a course that drives it: what the rig's integrator and CVODE are held
/// against each other on.
#include <cmath>
#include <numbers>

#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig::reference {

/// The size-6 valve without dry friction, iron hysteresis and supply ripple.
inline PlantParameters smooth_plant() {
  PlantParameters p;
  p.spool_friction.base_N = 0.0;
  p.flow_force.lateral_friction = 0.0;
  p.flow_force.friction_per_pressure_N_per_Pa = 0.0;
  p.supply.ripple_Pa = 0.0;
  for (Solenoid* solenoid : {&p.solenoid_a, &p.solenoid_b}) {
    solenoid->friction.base_N = 0.0;
    solenoid->side_friction_coefficient = 0.0;
    solenoid->hysteresis.kind = HysteresisKind::jiles_atherton;  // without pinning: its anhysteretic curve alone
    solenoid->hysteresis.coercive_field_A_per_m = 0.0;
  }
  return p;
}

/// Input over the electronics period that begins at `time_s`: a step of the voltage, then a swing about its new value
/// through both directions' edges, at 60 bar that swing too.
inline PlantInput smooth_drive(double time_s) {
  const double swing = std::sin(2.0 * std::numbers::pi * 11.0 * time_s);
  PlantInput input;
  input.voltage_b_V = 5.0 + 2.0 * swing;
  input.held_pressure_difference_Pa = 60e5 + 10e5 * std::sin(2.0 * std::numbers::pi * 7.0 * time_s);
  input.supply_pressure_Pa = 100e5;
  return input;
}

/// Full scale of the figures that trajectories are compared in.
inline constexpr double full_stroke_m = 2.4e-3;
inline constexpr double full_force_N = 140.0;
inline constexpr double full_flow_m3_per_s = 80.0 / 60000.0;

/// Largest distances between two trajectories over full scale.
struct TrajectoryError {
  double position = 0.0, force = 0.0, flow = 0.0;

  void compare(const PlantOutput& one, const PlantOutput& two) {
    position = std::max(position, std::abs(one.position_m - two.position_m) / full_stroke_m);
    force = std::max({force, std::abs(one.magnetic_force_N - two.magnetic_force_N) / full_force_N,
                      std::abs(one.flow_force_N - two.flow_force_N) / full_force_N});
    flow = std::max(flow, std::abs(one.flow_m3_per_s - two.flow_m3_per_s) / full_flow_m3_per_s);
  }
  [[nodiscard]] double largest() const { return std::max({position, force, flow}); }
};

}  // namespace spoolflow::rig::reference
