#include "tests/architecture/file_rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace spoolflow::architecture {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& path) {
  return path.extension() == ".hpp" || path.extension() == ".cpp";
}

bool says_nothing(const std::string& name) {
  static const std::regex empty_name(R"((^|_)(utils?|utilities|common|helpers?|misc|stuff|dev)(_|$))");
  return std::regex_search(name, empty_name);
}

void check_name(const fs::path& place, std::vector<std::string>& violations) {
  for (const fs::path& part : place) {
    if (!says_nothing(part.stem().string())) continue;
    violations.push_back(fmt::format("{}: '{}' says nothing about the content", place.generic_string(), part.string()));
  }
}

/// Whether one of the words stands in a line, as a word of its own.
class WordRule {
 public:
  explicit WordRule(std::vector<std::string> words)
      : words_(std::move(words)), whole_(fmt::format("\\b({})\\b", fmt::join(words_, "|"))) {}
  [[nodiscard]] bool met_in(const std::string& line) const {  // regular expressions take a hundred times as long
    const auto stands = [&](const std::string& word) { return line.find(word) != std::string::npos; };
    return std::ranges::any_of(words_, stands) && std::regex_search(line, whole_);
  }

 private:
  std::vector<std::string> words_;
  std::regex whole_;
};

void check_content(const fs::path& file, const fs::path& place, std::vector<std::string>& violations) {
  // Written apart, so that this file does not find itself.
  static const WordRule unfinished{
      {"TO"
       "DO",
       "FIX"
       "ME",
       "X"
       "XX"}};
  static const WordRule opens_output{{"std::ofstream", "std::fstream", "fopen"}};
  const std::string name = place.generic_string();
  static const std::regex extension(R"(gnu::|__attribute__|__builtin|__asm|#\s*pragma\s+(GCC|clang))");
  const bool standard = name.starts_with("spoolflow/sensor/") && name != "spoolflow/sensor/basis/compiler.hpp";
  const bool may_open = !name.starts_with("spoolflow/") || name.starts_with("spoolflow/apps/");
  std::ifstream in(file);
  int lines = 0;
  bool once = false;
  for (std::string line; std::getline(in, line);) {
    ++lines;
    once = once || line == "#pragma once";
    if (unfinished.met_in(line)) violations.push_back(fmt::format("{}:{}: unfinished work", name, lines));
    if (!may_open && opens_output.met_in(line)) {
      violations.push_back(fmt::format("{}:{}: only apps opens output files", name, lines));
    }
    if (standard && std::regex_search(line, extension)) {
      violations.push_back(
          fmt::format("{}:{}: extensions of compilers stand in sensor/basis/compiler.hpp", name, lines));
    }
  }
  if (file.extension() == ".hpp" && !once) violations.push_back(fmt::format("{}: no #pragma once", name));
  if (lines > longest_file_lines) {
    violations.push_back(
        fmt::format("{}: {} lines; past {} look for the second concept", name, lines, longest_file_lines));
  }
}

}  // namespace

std::vector<std::string> file_violations(const fs::path& root) {
  std::vector<std::string> violations;
  for (const char* folder : {"spoolflow", "addons", "tests", "bench", "examples"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path())) continue;
      const fs::path place = fs::relative(entry.path(), root);
      check_name(place, violations);
      check_content(entry.path(), place, violations);
    }
  }
  std::sort(violations.begin(), violations.end());
  return violations;
}

}  // namespace spoolflow::architecture
