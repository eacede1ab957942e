#include "tests/architecture/sources.hpp"

#include <algorithm>
#include <string>

namespace spoolflow::architecture {

namespace fs = std::filesystem;

std::vector<fs::path> sources_below(const fs::path& root) {
  std::vector<fs::path> sources;
  for (const char* folder : {"spoolflow", "addons"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string place = entry.path().lexically_relative(root).generic_string();
      const bool elsewhere = place.starts_with("addons/playground/wasm/") ||
                             (place.starts_with("addons/") && place.find("/tests/") != std::string::npos);
      if (!elsewhere && (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp"))
        sources.push_back(entry.path());
    }
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

}  // namespace spoolflow::architecture
