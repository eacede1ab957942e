#pragma once
/// What the sensor's FMU shows: inputs, outputs, and the parameters that may be tuned.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/export/fmu/sensor_directions.hpp"
#include "spoolflow/export/fmu/variable.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

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

/// How an FMU shows a number of the model that it lets its user tune.
struct Tunable {
  std::string_view key;  ///< as in the model file
  std::string_view name;
  std::string_view display_unit;
};

/// In the order of the description; numbers that this estimator does not have are not among them.
struct TunableNumber {
  std::string name;  ///< as shown; of a whole valve behind "b." or "a.", the direction
  Tunable shown;
  model::Parameter about;
  double* value;  ///< inside the parameters
};
[[nodiscard]] std::vector<TunableNumber> tunable_numbers(sensor::CondensedParameters<double>& parameters);
[[nodiscard]] std::vector<TunableNumber> tunable_numbers(sensor::ObserverParameters<double>& parameters);

[[nodiscard]] std::vector<TunableNumber> tunable_numbers(
    BothDirections<sensor::CondensedParameters<double>>& parameters);
[[nodiscard]] std::vector<TunableNumber> tunable_numbers(
    BothDirections<sensor::ObserverParameters<double>>& parameters);

/// Scales of one valve, for nominal values.
struct SensorScale {
  double rated_flow_m3_per_s;
  double stroke_m;
  bool whole = false;  ///< both directions
};

/// All variables; start values of the tunable ones are the model's.
[[nodiscard]] std::vector<Variable> sensor_variables(const SensorScale& scale,
                                                     const std::vector<TunableNumber>& tunable);

}  // namespace spoolflow::exports::fmu
