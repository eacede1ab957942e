#pragma once
#include <span>
#include <string>
#include <vector>

#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/fmu_content.hpp"

namespace spoolflow::exports {

/// Libraries for other platforms: "sensor_fmu.dll", "sensor_fmu_aarch64.so" and the valve's. Empty where the add-on
/// `cross` is not built in.
[[nodiscard]] std::span<const EmbeddedFile>& foreign_fmu_binaries();
/// Whether FMUs get libraries for Windows: where the add-on `cross` is built in.
[[nodiscard]] bool windows_is_served();
/// Those of the files that a compiler is given.
[[nodiscard]] std::vector<std::string> translation_units(std::span<const EmbeddedFile> sources);

/// The FMU as a file: modelDescription.xml, binaries, sources, resource, documentation, icon, licence. `library`:
/// "sensor_fmu" or "valve_fmu", of which what could be built where this program was goes in; `sources`: everything in
/// the folder sources, named by its path there. The token of the content's resource is set here.
[[nodiscard]] std::string fmu_archive(FmuContent content, const std::string& library,
                                      std::span<const EmbeddedFile> sources, FmiVersion version);

}  // namespace spoolflow::exports
