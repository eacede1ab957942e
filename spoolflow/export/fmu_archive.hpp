#pragma once
#include <span>
#include <string>

#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/fmu_content.hpp"

namespace spoolflow::exports {

/// What travels inside the program for one FMU.
struct FmuParts {
  std::string_view linux64;  ///< shared library; each empty where this program was built without a compiler for it
  std::string_view win64;    ///< the same for Windows
  std::string_view aarch64;  ///< for Linux on 64-bit Arm, in FMI 3.0 alone: 2.0 has no name for that platform
  std::span<const EmbeddedFile> sources;  ///< everything in the FMU's folder sources, named by its path there
};

/// The FMU as a file: modelDescription.xml, binaries, sources, resource, documentation, icon, licence. The token of the
/// content's resource is set here.
[[nodiscard]] std::string fmu_archive(FmuContent content, const FmuParts& parts, FmiVersion version);

}  // namespace spoolflow::exports
