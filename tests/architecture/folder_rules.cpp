#include "tests/architecture/folder_rules.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/architecture/sources.hpp"

namespace spoolflow::architecture {
namespace {

namespace fs = std::filesystem;

/// By the path from the root without its ending, which header and source share: what each subject includes.
using Subjects = std::map<std::string, std::set<std::string>>;

std::string subject_of(fs::path place) {
  return place.replace_extension().generic_string();
}

Subjects subjects_below(const fs::path& root) {
  static const std::regex include(R"re(^\s*#\s*include\s*"([^"]+)")re");
  Subjects subjects;
  for (const fs::path& source : sources_below(root)) {
    std::set<std::string>& included = subjects[subject_of(source.lexically_relative(root))];
    std::ifstream in(source);
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, include)) included.insert(subject_of(match[1].str()));
    }
  }
  for (auto& [subject, included] : subjects) included.erase(subject);
  return subjects;
}

class CircleFinder {
 public:
  explicit CircleFinder(const Subjects& subjects) : subjects_(subjects) {
    for (const auto& [subject, included] : subjects) follow(subject);
  }
  std::vector<std::string> found;

 private:
  /// Depth first; what was once followed to its end leads into no further circle.
  void follow(const std::string& subject) {
    const auto met = std::find(way_.begin(), way_.end(), subject);
    if (met != way_.end()) {
      found.push_back(fmt::format("round in a circle: {} -> {}", fmt::join(met, way_.end(), " -> "), subject));
      return;
    }
    const auto place = subjects_.find(subject);
    if (place == subjects_.end() || !followed_.insert(subject).second) return;
    way_.push_back(subject);
    for (const std::string& next : place->second) follow(next);
    way_.pop_back();
  }

  const Subjects& subjects_;
  std::vector<std::string> way_;
  std::set<std::string> followed_;
};

}  // namespace

std::vector<std::string> full_folders(const fs::path& root) {
  std::map<std::string, std::size_t> held;
  for (const auto& [subject, included] : subjects_below(root)) {
    ++held[fs::path(subject).parent_path().generic_string()];
  }
  std::vector<std::string> full;
  for (const auto& [folder, count] : held) {
    if (count > most_subjects) {
      full.push_back(fmt::format("{} holds {} subjects; past {} divide it", folder, count, most_subjects));
    }
  }
  return full;
}

std::vector<std::string> circles(const fs::path& root) {
  return CircleFinder(subjects_below(root)).found;
}

}  // namespace spoolflow::architecture
