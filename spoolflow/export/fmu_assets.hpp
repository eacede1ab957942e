#pragma once
#include <span>

#include "spoolflow/export/embedded_file.hpp"

namespace spoolflow::exports {

/// "icon.png", "icon.svg" and "LICENSE".
[[nodiscard]] std::span<const EmbeddedFile> fmu_assets();

}  // namespace spoolflow::exports
