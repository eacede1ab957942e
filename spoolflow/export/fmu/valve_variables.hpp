#pragma once
/// What the virtual valve's FMU shows: set values and surroundings in, what the electronics measure and what is true
/// out.
#include <cstdint>
#include <vector>

#include "spoolflow/export/fmu/valve_numbers.hpp"
#include "spoolflow/export/fmu/variable.hpp"

namespace spoolflow::exports::fmu {

enum ValveReference : std::uint32_t {
  valve_time,
  valve_position_set,
  valve_pressure_difference_set,
  valve_supply_pressure,
  valve_load_force,
  valve_oil_temperature_set,
  valve_ambient_temperature,
  valve_current,
  valve_voltage,
  valve_position,
  valve_oil_temperature,
  valve_flow,
  valve_pressure_difference,
  valve_true_position,
  valve_magnetic_force,
  valve_flow_force,
  valve_friction_force,
  valve_pressure_P,
  valve_pressure_A,
  valve_pressure_B,
  valve_cylinder_position,
  valve_sample_step,
  valve_seed,
  valve_dither_amplitude,
  valve_dither_frequency,
  valve_supply_ripple,
  valve_current_a,
  valve_current_b,
  valve_voltage_a,
  valve_voltage_b,
  valve_true_velocity,
  valve_true_acceleration,
  valve_cylinder_velocity
};

[[nodiscard]] std::vector<Variable> valve_variables(const VirtualValve& valve, double rated_flow_m3_per_s);

}  // namespace spoolflow::exports::fmu
