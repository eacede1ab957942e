#pragma once
#include <span>

#include "spoolflow/export/embedded_file.hpp"

namespace spoolflow::exports {

/// Shared libraries of the FMUs for the platform that this program is built for: "sensor_fmu.so" and the valve's, on
/// 64-bit Arm "sensor_fmu_aarch64.so".
[[nodiscard]] std::span<const EmbeddedFile> fmu_binaries();

}  // namespace spoolflow::exports
