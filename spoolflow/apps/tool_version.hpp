#pragma once
#include <string_view>

namespace spoolflow::apps {

/// The project's version, such as "1.0.0"; written into models and reports.
[[nodiscard]] std::string_view tool_version();

}  // namespace spoolflow::apps
