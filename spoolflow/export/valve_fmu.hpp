#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "spoolflow/export/fmu_content.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::exports {

/// What the virtual valve's FMU shows and holds, but its token.
[[nodiscard]] FmuContent valve_fmu_content(const rig::ValveUnderTest& valve, std::string_view tool_version);
/// A valve of the virtual rig, with its spread and wear, as a co-simulation FMU: plant, on-board electronics and the
/// instruments at the valve. Its outputs current, voltage, position and oil_temperature are the inputs of the sensor's
/// FMU.
[[nodiscard]] std::string valve_fmu(const rig::ValveUnderTest& valve, FmiVersion version,
                                    std::string_view tool_version);

/// Virtual valve and sensor, connected, as a file of System Structure and Parameterization (SSP).
using SystemPackage = std::function<std::string(const model::Model&, const rig::ValveUnderTest&, FmiVersion,
                                                std::string_view tool_version)>;
/// Empty where the add-on `cross` is not built in.
[[nodiscard]] SystemPackage& system_package();

}  // namespace spoolflow::exports
