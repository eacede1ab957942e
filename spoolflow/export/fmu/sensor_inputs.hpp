#pragma once
/// What the sensor's FMU reads at each sample: value references, variables, and the sample that they become.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/estimation/timed_sample.hpp"
#include "spoolflow/export/fmu/variable.hpp"

namespace spoolflow::exports::fmu {

/// Value references of what the component itself reads and writes; tunable parameters follow. A whole valve's current
/// and voltage are those of solenoid b; solenoid a has two inputs of its own, and the tunable parameters follow those.
enum SensorReference : std::uint32_t {
  sensor_time,
  sensor_current,
  sensor_voltage,
  sensor_position,
  sensor_oil_temperature,
  sensor_flow,
  sensor_flow_lower,
  sensor_flow_upper,
  sensor_pressure_difference,
  sensor_magnetic_force,
  sensor_spring_force,
  sensor_flow_force,
  sensor_friction_force,
  sensor_status,
  sensor_fault,
  sensor_sample_step,
  sensor_use_voltage,
  sensor_use_oil_temperature,
  sensor_first_tunable,
  whole_current_a = sensor_first_tunable,
  whole_voltage_a,
  whole_pressure_p,
  whole_pressure_a,
  whole_pressure_b,
  whole_pressure_t,
  whole_use_port_pressures,
  whole_first_tunable
};

inline Variable flag(const char* name, const char* description, bool start = true) {
  return {.name = name,
          .description = description,
          .causality = Causality::parameter,
          .variability = Variability::fixed,
          .type = Type::boolean,
          .start = start ? 1.0 : 0.0,
          .lowest = 0,
          .highest = 1};
}

/// Behind the time; of a whole valve the coil is that of solenoid b.
inline std::vector<Variable> sensor_inputs(bool whole, double stroke_m) {
  return {input(whole ? "current_b" : "current",
                whole ? "current of the coil that opens P to B, mean since the sample before; NaN: missing"
                      : "coil current, mean since the sample before; NaN: missing",
                "A", "", 0, 1),
          input(whole ? "voltage_b" : "voltage",
                whole ? "voltage of the coil that opens P to B, mean since the sample before; NaN: not measured"
                      : "coil voltage, mean since the sample before; NaN: not measured",
                "V", "", 0, 10),
          input("position",
                whole ? "spool position from the centre, > 0 opens P to B, < 0 opens P to A; NaN: missing"
                      : "spool position, 0 closed, > 0 opens P to B; NaN: missing",
                "m", "mm", 0, stroke_m),
          input("oil_temperature", "temperature of the oil; NaN: the last one is held", "K", "degC", 323.15, 300)};
}

/// What a whole valve has beside one direction's inputs.
inline std::vector<Variable> whole_valve_inputs() {
  const auto pressure = [](const char* name, const char* port) {
    return input(name, (std::string("pressure at port ") + port + "; NaN: not measured").c_str(), "Pa", "bar", 0, 5e6);
  };
  return {input("current_a", "current of the coil that opens P to A, mean since the sample before; NaN: missing", "A",
                "", 0, 1),
          input("voltage_a", "voltage of the coil that opens P to A, mean since the sample before; NaN: not measured",
                "V", "", 0, 10),
          pressure("pressure_p", "P"),
          pressure("pressure_a", "A"),
          pressure("pressure_b", "B"),
          pressure("pressure_t", "T"),
          flag("use_port_pressures", "whether the pressures at all four ports are measured", false)};
}

/// The sample of that number, counted from the start, from the values of the variables by their references.
inline estimation::TimedSample timed_sample(std::span<const double> values, std::int64_t number, bool whole) {
  const double nothing = estimation::not_measured;
  const bool use_voltage = values[sensor_use_voltage] != 0;
  const double time_s = static_cast<double>(number) * values[sensor_sample_step];
  const double voltage_V = use_voltage ? values[sensor_voltage] : nothing;
  const double oil_temperature_K = values[sensor_use_oil_temperature] != 0 ? values[sensor_oil_temperature] : nothing;
  if (whole) {
    const auto pressure_Pa = [&](std::size_t port) {
      return values[whole_use_port_pressures] != 0 ? values[port] : nothing;
    };
    return estimation::of_both_coils({.time_s = time_s,
                                      .current_a_A = values[whole_current_a],
                                      .current_b_A = values[sensor_current],
                                      .voltage_a_V = use_voltage ? values[whole_voltage_a] : nothing,
                                      .voltage_b_V = voltage_V,
                                      .position_m = values[sensor_position],
                                      .oil_temperature_K = oil_temperature_K,
                                      .ports = {pressure_Pa(whole_pressure_p), pressure_Pa(whole_pressure_a),
                                                pressure_Pa(whole_pressure_b), pressure_Pa(whole_pressure_t)}});
  }
  return {.time_s = time_s,
          .current_A = values[sensor_current],
          .voltage_V = voltage_V,
          .position_m = values[sensor_position],
          .oil_temperature_K = oil_temperature_K};
}

}  // namespace spoolflow::exports::fmu
