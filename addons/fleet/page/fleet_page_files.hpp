#pragma once
#include <span>

#include "addons/live/embedded_file.hpp"

namespace spoolflow::live {

/// fleet.html, fleet.js and fleet.css, as web/ was built.
[[nodiscard]] std::span<const EmbeddedFile> fleet_page_files();

}  // namespace spoolflow::live
