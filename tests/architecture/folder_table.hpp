#pragma once
/// The table of docs/ARCHITECTURE.md: what each folder of spoolflow/ may include.
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace spoolflow::architecture {

struct FolderRule {
  std::set<std::string> folders;    ///< of spoolflow/, beside itself
  std::set<std::string> libraries;  ///< names as in the table: "fmt", "CLI11", "POSIX"
  std::set<std::string> never;      ///< forbidden words of the last column
  bool all_folders = false;
  bool freestanding = false;  ///< of the standard library only what a bare-metal compiler has
};

using FolderTable = std::map<std::string, FolderRule>;

/// Throws std::runtime_error where the table is missing, misshapen or contradicts itself.
[[nodiscard]] FolderTable read_folder_table(const std::filesystem::path& architecture_page);

}  // namespace spoolflow::architecture
