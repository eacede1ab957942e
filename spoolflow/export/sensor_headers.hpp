#pragma once
#include <span>

#include "spoolflow/export/embedded_file.hpp"

namespace spoolflow::exports {

/// The headers of spoolflow/sensor as they stood when this program was built.
[[nodiscard]] std::span<const EmbeddedFile> sensor_headers();

}  // namespace spoolflow::exports
