#pragma once
/// The links of every folder's CMake target against the folder table.
#include <filesystem>
#include <string>
#include <vector>

#include "tests/architecture/folder_table.hpp"

namespace spoolflow::architecture {

/// `links` is what configuring wrote: a line for each target, such as "spoolflow_model: spoolflow_sensor fmt::fmt".
[[nodiscard]] std::vector<std::string> link_violations(const FolderTable& table, const std::filesystem::path& links);

}  // namespace spoolflow::architecture
