#pragma once
#include <string>
#include <string_view>

#include "spoolflow/export/sensor_fmu.hpp"
#include "spoolflow/export/valve_fmu.hpp"

namespace spoolflow::exports {

/// An SSP file (System Structure and Parameterization 1.0, which 2.0 reads): both FMUs in `resources` and
/// SystemStructure.ssd. Every input of the sensor that the valve has an output for is connected to it. The system takes
/// the valve's `position_set` and `pressure_difference_set` and gives the sensor's outputs, beside them the valve's
/// true flow and pressure difference as `true_flow`, `true_pressure_difference`.
[[nodiscard]] std::string valve_and_sensor(const model::Model& model, const rig::ValveUnderTest& valve,
                                           FmiVersion version, std::string_view tool_version);

}  // namespace spoolflow::exports
