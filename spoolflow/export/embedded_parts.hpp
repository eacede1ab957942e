#pragma once
#include <string>
#include <vector>

#include "spoolflow/export/fmu_archive.hpp"

namespace spoolflow::exports {

/// The binaries of "sensor_fmu" or "valve_fmu", with its sources.
[[nodiscard]] FmuParts embedded_parts(const std::string& name, std::span<const EmbeddedFile> sources);
/// Whether FMUs get libraries for Windows: not where this program was built without a compiler for it.
[[nodiscard]] bool windows_is_served();
/// Those of the files that a compiler is given.
[[nodiscard]] std::vector<std::string> translation_units(std::span<const EmbeddedFile> sources);

}  // namespace spoolflow::exports
