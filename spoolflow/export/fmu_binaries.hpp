#pragma once
#include <span>

#include "spoolflow/export/embedded_file.hpp"

namespace spoolflow::exports {

/// Shared libraries of the FMUs for both platforms: "sensor_fmu.so", "sensor_fmu.dll" and the valve's.
[[nodiscard]] std::span<const EmbeddedFile> fmu_binaries();

}  // namespace spoolflow::exports
