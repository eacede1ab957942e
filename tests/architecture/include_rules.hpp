#pragma once
/// Every #include of spoolflow/ against the folder table.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/architecture/folder_table.hpp"

namespace spoolflow::architecture {

/// Which library a header in angle brackets belongs to, by its table name; "std" for the standard library, nothing
/// where unknown.
[[nodiscard]] std::optional<std::string> library_of(const std::string& header);

/// One line a violation, with file and line number; `root` holds the folder spoolflow/.
[[nodiscard]] std::vector<std::string> include_violations(const FolderTable& table, const std::filesystem::path& root);

}  // namespace spoolflow::architecture
