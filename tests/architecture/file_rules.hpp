#pragma once
/// Project rules that each source file keeps for itself.
#include <filesystem>
#include <string>
#include <vector>

namespace spoolflow::architecture {

inline constexpr int longest_file_lines = 350;

/// Looks at spoolflow/, tests/, bench/ and examples/ of `root`: no file of more than 350 lines, `#pragma once` in every
/// header, no name that says nothing (utils, common, helpers, misc), no unfinished work left in a comment, and outputs
/// opened nowhere in spoolflow/ but in apps.
[[nodiscard]] std::vector<std::string> file_violations(const std::filesystem::path& root);

}  // namespace spoolflow::architecture
