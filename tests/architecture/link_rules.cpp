#include "tests/architecture/link_rules.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

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
    {"OpenSSL::SSL", "OpenSSL"},
    {"Eigen3::Eigen", "Eigen"},
    {"Boost::headers", "Boost"},
    {"FastFloat::fast_float", "fast_float"},
    {"PkgConfig::LIBZIP", "libzip"},
    {"PkgConfig::SECCOMP", "libseccomp"},
    {"PkgConfig::EXPAT", "expat"},
    {"ZLIB::ZLIB", "zlib"},
    {"PkgConfig::SQLITE3", "SQLite"},
    {"PkgConfig::ZSTD", "zstd"},
    {"PkgConfig::LIBPQ", "libpq"},
    {"PkgConfig::NATS", "NATS"},
    {"CURL::libcurl", "libcurl"},
    {"PkgConfig::modbus", "libmodbus"},
    {"Paho::MQTT", "Paho"},
    {"pybind11::headers", "pybind11"},
    {"Python3::Module", "pybind11"},
};

const std::string prefix = "spoolflow_", addon_prefix = "addons_";

/// The row of a target: "rig/plant" of spoolflow_rig_plant, "addons/live" of addons_live. Empty: none.
std::string row_of_target(const FolderTable& table, const std::string& target) {
  for (const auto& [row, rule] : table) {
    std::string name = row.starts_with("addons/") ? row : prefix + row;
    std::replace(name.begin(), name.end(), '/', '_');
    if (name == target) return row;
  }
  return {};
}

std::string violation(const FolderTable& table, const std::string& folder, const std::string& link) {
  const FolderRule& rule = table.at(folder);
  if (link.starts_with(prefix) || link.starts_with(addon_prefix)) {
    if (link == "spoolflow_settings" || link == "spoolflow_warnings") return {};
    const std::string other = row_of_target(table, link);
    if (other.empty()) return fmt::format("{} links {}, which is no folder of the table", folder, link);
    if (other == folder || allows(rule, other)) return {};
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
  std::set<std::string> without_target;
  for (const auto& [row, rule] : table) without_target.insert(row);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string target, link;
    words >> target;
    if (target.ends_with(':')) target.pop_back();
    const std::string folder = row_of_target(table, target);
    if (folder.empty()) {
      violations.push_back(fmt::format("the target {} has no folder in the table", target));
      continue;
    }
    without_target.erase(folder);
    while (words >> link) {
      std::string found = violation(table, folder, link);
      if (!found.empty()) violations.push_back(std::move(found));
    }
  }
  for (const std::string& row : without_target) {
    violations.push_back(fmt::format("the folder {} has no target of its own", row));
  }
  return violations;
}

}  // namespace spoolflow::architecture
