#pragma once
#include <span>

#include "addons/live/embedded_file.hpp"

namespace spoolflow::live {

/// The model of the valve size_6 of the virtual rig, examples/live/size_6.json.
[[nodiscard]] std::span<const EmbeddedFile> demo_model();

}  // namespace spoolflow::live
