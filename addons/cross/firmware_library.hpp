#pragma once
#include <string>
#include <vector>

#include "spoolflow/export/c_folder.hpp"

namespace spoolflow::exports {

/// The archive libvalve_sensor.a of an exported folder for a target, by arm-none-eabi-g++ and arm-none-eabi-ar on the
/// path. The same sources and compiler give the same bytes. Throws std::runtime_error with the compiler's first words,
/// or with the packages to install.
[[nodiscard]] std::string firmware_library(const std::vector<ExportedFile>& sources, const FirmwareTarget& target);

}  // namespace spoolflow::exports
