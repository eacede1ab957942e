#include "tests/architecture/folder_table.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spoolflow::architecture {
namespace {

const std::string addons = "addons/";
const std::string alone = " alone";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" `");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" `") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(trimmed(text.substr(begin, end == std::string::npos ? end : end - begin)));
  }
  return parts;
}

FolderRule read_rule(const std::string& may_include, const std::string& libraries, const std::string& never) {
  FolderRule rule;
  for (const std::string& word : split(may_include, ',')) {
    if (word == "all") {
      rule.all_folders = true;
    } else if (word == "freestanding std") {
      rule.freestanding = true;
    } else if (word.ends_with(alone)) {
      rule.alone.insert(word.substr(0, word.size() - alone.size()));
    } else if (word != "std") {
      rule.folders.insert(word);
    }
  }
  for (const std::string& word : split(libraries, ',')) {
    if (word != "-") rule.libraries.insert(word);
  }
  for (const std::string& word : split(never, ',')) rule.never.insert(word);
  return rule;
}

/// The rows that a name in a cell means: itself, and the parts below it. In the row of such a part the name of its own
/// folder means that folder without its parts.
std::vector<std::string> rows_meant(const FolderTable& table, const std::string& name, const std::string& in_row = {}) {
  std::vector<std::string> rows;
  const bool own = in_row.starts_with(name + "/");
  for (const auto& [row, rule] : table) {
    if (row == name || (!own && row.starts_with(name + "/"))) rows.push_back(row);
  }
  return rows;
}

/// Follows what may be included from the last of `way`, and throws where that leads back to a row on the way. `done`:
/// rows from which no way leads round.
void follow(const FolderTable& table, std::vector<std::string>& way, std::set<std::string>& done) {
  const std::string row = way.back();
  if (done.contains(row)) return;
  std::vector<std::string> rows(table.at(row).alone.begin(), table.at(row).alone.end());
  for (const std::string& name : table.at(row).folders) {
    for (std::string& meant : rows_meant(table, name, row)) rows.push_back(std::move(meant));
  }
  for (const std::string& next : rows) {
    const bool round = std::find(way.begin(), way.end(), next) != way.end();
    way.push_back(next);
    if (round) throw std::runtime_error(fmt::format("round in a circle: {}", fmt::join(way, " -> ")));
    follow(table, way, done);
    way.pop_back();
  }
  done.insert(row);
}

void check(const FolderTable& table) {
  std::set<std::string> done;
  for (const auto& [folder, rule] : table) {
    for (const std::string& other : rule.folders) {
      if (rows_meant(table, other).empty())
        throw std::runtime_error(fmt::format("{} may include {}, which is no folder", folder, other));
      if (rule.never.contains(other))
        throw std::runtime_error(fmt::format("{} both may and must not include {}", folder, other));
    }
    for (const std::string& other : rule.alone) {
      if (!table.contains(other))
        throw std::runtime_error(fmt::format("{} may include {} alone, which has no row", folder, other));
    }
    std::vector<std::string> way{folder};
    follow(table, way, done);
  }
}

}  // namespace

std::vector<std::string> with_those_above(std::string folder) {
  std::vector<std::string> folders{folder};
  for (std::size_t end = folder.rfind('/'); end != std::string::npos; end = folder.rfind('/')) {
    folder.resize(end);
    folders.push_back(folder);
  }
  return folders;
}

std::string row_of(const FolderTable& table, const std::string& folder) {
  for (const std::string& row : with_those_above(folder)) {
    if (row != folder && rows_meant(table, row).size() > 1) return {};
    if (table.contains(row)) return row;
  }
  return {};
}

bool allows(const FolderRule& rule, const std::string& other) {
  const std::vector<std::string> names = with_those_above(other);
  return (rule.all_folders && !other.starts_with("addons/")) || rule.alone.contains(other) ||
         std::any_of(names.begin(), names.end(), [&](const std::string& name) {
           return rule.folders.contains(name) && (name == other || name != rule.parent);
         });
}

FolderTable read_folder_table(const std::filesystem::path& architecture_page) {
  std::ifstream page(architecture_page);
  FolderTable table;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    const std::vector<std::string> cells = split(line, '|');  // the first and the last are empty
    if (line.starts_with("| folder ")) {
      inside = cells.size() == 7 && cells[3] == "may include" && cells[4] == "libraries" && cells[5] == "never";
      continue;
    }
    if (!inside || line.starts_with("|---")) continue;
    if (!line.starts_with('|')) break;
    if (cells.size() != 7) throw std::runtime_error("a row of the folder table has not five columns: " + line);
    FolderRule rule = read_rule(cells[3], cells[4], cells[5]);
    const std::size_t slash = cells[1].find('/', cells[1].starts_with(addons) ? addons.size() : 0);
    if (slash != std::string::npos) rule.parent = cells[1].substr(0, slash);
    table.emplace(cells[1], std::move(rule));
  }
  if (table.empty()) throw std::runtime_error("no folder table in " + architecture_page.string());
  check(table);
  return table;
}

}  // namespace spoolflow::architecture
