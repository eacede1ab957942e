#pragma once
/// The drawing of docs/ARCHITECTURE.md: a folder stands on the floor above the highest one that it may include.
#include <filesystem>
#include <map>
#include <string>

#include "tests/architecture/folder_table.hpp"

namespace spoolflow::architecture {

/// The ground is floor 1.
using Floors = std::map<std::string, int>;

/// As the table makes them.
[[nodiscard]] Floors floors(const FolderTable& table);

/// As they are drawn: lines such as "  3  estimation  rig/plant" between ```floors and ```; a line without a number
/// goes on with the floor above it. Throws std::runtime_error where there is no drawing.
[[nodiscard]] Floors drawn_floors(const std::filesystem::path& architecture_page);

}  // namespace spoolflow::architecture
