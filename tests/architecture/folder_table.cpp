#include "tests/architecture/folder_table.hpp"

#include <fstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace spoolflow::architecture {
namespace {

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

void check(const FolderTable& table) {
  for (const auto& [folder, rule] : table) {
    for (const std::string& other : rule.folders) {
      if (!table.contains(other))
        throw std::runtime_error(fmt::format("{} may include {}, which is no folder", folder, other));
      if (rule.never.contains(other))
        throw std::runtime_error(fmt::format("{} both may and must not include {}", folder, other));
    }
  }
}

}  // namespace

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
    table.emplace(cells[1], read_rule(cells[3], cells[4], cells[5]));
  }
  if (table.empty()) throw std::runtime_error("no folder table in " + architecture_page.string());
  check(table);
  return table;
}

}  // namespace spoolflow::architecture
