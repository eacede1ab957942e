#pragma once
#include <span>

#include "spoolflow/export/embedded_file.hpp"

namespace spoolflow::exports {

/// The files of an exported folder that are the same for every valve, and the frame of its README: NAME.in each.
[[nodiscard]] std::span<const EmbeddedFile> cpp_texts();

}  // namespace spoolflow::exports
