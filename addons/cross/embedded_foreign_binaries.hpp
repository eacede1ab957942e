#pragma once
#include <span>

#include "spoolflow/export/embedded_files.hpp"

namespace spoolflow::exports {

/// "sensor_fmu.dll", "sensor_fmu_aarch64.so" and the valve's.
[[nodiscard]] std::span<const EmbeddedFile> embedded_foreign_binaries();

}  // namespace spoolflow::exports
