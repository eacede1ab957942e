#include "tests/architecture/link_rules.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace spoolflow::architecture {
namespace {

const std::map<std::string, std::string> library_of_target{
    {"fmt::fmt", "fmt"},
    {"nlohmann_json::nlohmann_json", "nlohmann-json"},
    {"tomlplusplus::tomlplusplus", "toml++"},
    {"CLI11::CLI11", "CLI11"},
    {"hdf5::hdf5", "HDF5"},
    {"PkgConfig::MATIO", "matio"},
    {"OpenSSL::Crypto", "OpenSSL"},
    {"Ceres::ceres", "Ceres"},
    {"Eigen3::Eigen", "Eigen"},
    {"Boost::headers", "Boost"},
    {"PkgConfig::LIBZIP", "libzip"},
};

std::string violation(const std::string& folder, const FolderRule& rule, const std::string& link) {
  const std::string prefix = "spoolflow_";
  if (link.starts_with(prefix)) {
    const std::string other = link.substr(prefix.size());
    if (other == "settings" || other == "warnings" || other == folder) return {};
    if (rule.all_folders || rule.folders.contains(other)) return {};
    return fmt::format("the target of {} must not link {}", folder, other);
  }
  const auto library = library_of_target.find(link);
  if (library == library_of_target.end())
    return fmt::format("{} links {}, which is no library of the table", folder, link);
  if (rule.libraries.contains(library->second)) return {};
  return fmt::format("the target of {} must not link {}", folder, library->second);
}

}  // namespace

std::vector<std::string> link_violations(const FolderTable& table, const std::filesystem::path& links) {
  std::ifstream in(links);
  std::vector<std::string> violations;
  std::size_t targets = 0;
  for (std::string line; std::getline(in, line); ++targets) {
    std::istringstream words(line);
    std::string target, link;
    words >> target;
    const std::string folder = target.substr(target.find('_') + 1, target.find(':') - target.find('_') - 1);
    const auto rule = table.find(folder);
    if (rule == table.end()) {
      violations.push_back(fmt::format("the target of {} has no folder in the table", folder));
      continue;
    }
    while (words >> link) {
      std::string found = violation(folder, rule->second, link);
      if (!found.empty()) violations.push_back(std::move(found));
    }
  }
  if (targets == 0) throw std::runtime_error("no targets in " + links.string());
  return violations;
}

}  // namespace spoolflow::architecture
