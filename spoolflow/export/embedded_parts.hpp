#pragma once
#include <span>
#include <string>
#include <vector>

#include "spoolflow/export/fmu_archive.hpp"

namespace spoolflow::exports {

/// Libraries for other platforms: "sensor_fmu.dll", "sensor_fmu_aarch64.so" and the valve's. Empty where the add-on
/// `cross` is not built in.
[[nodiscard]] std::span<const EmbeddedFile>& foreign_fmu_binaries();
/// The binaries of "sensor_fmu" or "valve_fmu", with its sources.
[[nodiscard]] FmuParts embedded_parts(const std::string& name, std::span<const EmbeddedFile> sources);
/// Whether FMUs get libraries for Windows: where the add-on `cross` is built in.
[[nodiscard]] bool windows_is_served();
/// Those of the files that a compiler is given.
[[nodiscard]] std::vector<std::string> translation_units(std::span<const EmbeddedFile> sources);

}  // namespace spoolflow::exports
