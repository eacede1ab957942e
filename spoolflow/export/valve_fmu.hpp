#pragma once
#include <string>
#include <string_view>

#include "spoolflow/export/fmu_content.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::exports {

/// A valve of the virtual rig, with its spread and wear, as a co-simulation FMU: plant, on-board electronics and the
/// instruments at the valve. Its outputs current, voltage, position and oil_temperature are the inputs of the sensor's
/// FMU.
[[nodiscard]] std::string valve_fmu(const rig::ValveUnderTest& valve, FmiVersion version,
                                    std::string_view tool_version);

}  // namespace spoolflow::exports
