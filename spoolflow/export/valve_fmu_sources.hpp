#pragma once
#include <span>

#include "spoolflow/export/embedded_file.hpp"

namespace spoolflow::exports {

/// What the virtual valve's FMU is compiled from, by its path from the project's root.
[[nodiscard]] std::span<const EmbeddedFile> valve_fmu_sources();

}  // namespace spoolflow::exports
