#pragma once
#include <span>

#include "addons/live/embedded_file.hpp"

namespace spoolflow::live {

/// live.html, live.js and live.css, as web/ was built.
[[nodiscard]] std::span<const EmbeddedFile> page_files();

}  // namespace spoolflow::live
