#pragma once
#include <filesystem>
#include <vector>

namespace spoolflow::architecture {

/// The sources and headers (.hpp, .cpp) below spoolflow/ and addons/, without the tests of add-ons and what is compiled
/// for a browser alone; in order.
[[nodiscard]] std::vector<std::filesystem::path> sources_below(const std::filesystem::path& root);

}  // namespace spoolflow::architecture
