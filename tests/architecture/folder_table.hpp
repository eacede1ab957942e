#pragma once
/// The table of docs/ARCHITECTURE.md: what each folder of spoolflow/, and each part of a divided folder, may include.
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace spoolflow::architecture {

struct FolderRule {
  std::string parent{};             ///< the folder that the row is a part of: its name means it alone here; empty: none
  std::set<std::string> folders;    ///< beside itself: "rig/plant", "rig" for all its parts, "addons/live"
  std::set<std::string> alone;      ///< "estimation": that folder without its parts
  std::set<std::string> libraries;  ///< names as in the table: "fmt", "CLI11", "POSIX"
  std::set<std::string> never;      ///< forbidden words of the last column
  bool all_folders = false;         ///< of the core; never of an add-on
  bool freestanding = false;        ///< of the standard library only what a bare-metal compiler has
};

/// By the folder's name below spoolflow/, or from addons/ on: "units", "rig/plant", "addons/live/http".
using FolderTable = std::map<std::string, FolderRule>;

/// `folder` and the folders that it stands in, from the inside out: "rig/plant", "rig".
[[nodiscard]] std::vector<std::string> with_those_above(std::string folder);
/// The row by which the files of `folder` live: its own; its parent's only where that has no parts of its own in the
/// table. Empty: none.
[[nodiscard]] std::string row_of(const FolderTable& table, const std::string& folder);
/// Whether what lives by `rule` may use files of the row `other`.
[[nodiscard]] bool allows(const FolderRule& rule, const std::string& other);

/// Throws std::runtime_error where the table is missing, misshapen, contradicts itself or leads round in a circle.
[[nodiscard]] FolderTable read_folder_table(const std::filesystem::path& architecture_page);

}  // namespace spoolflow::architecture
