#pragma once
/// Project rule of the library's functions: a reader holds one in view.
#include <filesystem>
#include <string>
#include <vector>

namespace spoolflow::architecture {

inline constexpr int longest_function_lines = 60;

/// Looks at spoolflow/ of `root`: no function of more than 60 lines, signature and braces counted, but where the line
/// before it begins with `// long: ` and gives the reason. Relies on clang-format: a function's braces close where its
/// signature begins.
[[nodiscard]] std::vector<std::string> function_violations(const std::filesystem::path& root);

}  // namespace spoolflow::architecture
