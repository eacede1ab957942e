#include "tests/architecture/floors.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace spoolflow::architecture {
namespace {

/// The table has no circle: read_folder_table() refuses one.
int floor_of(const FolderTable& table, const std::string& folder, Floors& known) {
  const auto found = known.find(folder);
  if (found != known.end()) return found->second;
  const FolderRule& rule = table.at(folder);
  int highest = 0;
  for (const auto& [other, others_rule] : table) {
    if (other != folder && allows(rule, other)) highest = std::max(highest, floor_of(table, other, known));
  }
  return known[folder] = highest + 1;
}

}  // namespace

Floors floors(const FolderTable& table) {
  Floors known;
  for (const auto& [folder, rule] : table) floor_of(table, folder, known);
  return known;
}

Floors drawn_floors(const std::filesystem::path& architecture_page) {
  std::ifstream page(architecture_page);
  Floors drawn;
  bool inside = false;
  int floor = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      inside = line == "```floors";
      continue;
    }
    if (!inside) continue;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (word.find_first_not_of("0123456789") == std::string::npos) {
        floor = std::stoi(word);
      } else {
        drawn[word] = floor;
      }
    }
  }
  if (drawn.empty()) throw std::runtime_error("no drawing of the floors in " + architecture_page.string());
  return drawn;
}

}  // namespace spoolflow::architecture
