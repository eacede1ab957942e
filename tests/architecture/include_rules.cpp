#include "tests/architecture/include_rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "tests/architecture/sources.hpp"

namespace spoolflow::architecture {
namespace {

namespace fs = std::filesystem;

// What GCC 12 and Clang 14 compile with -ffreestanding and without exceptions, and what needs no heap.
const std::set<std::string> freestanding_headers{"array",  "bit",     "cmath", "concepts",    "cstddef", "cstdint",
                                                 "limits", "numbers", "span",  "type_traits", "utility"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 35> library_prefixes{{
    {"experimental/", "std"},  // std::experimental::simd
    {"fmt/", "fmt"},
    {"nlohmann/", "nlohmann-json"},
    {"toml++/", "toml++"},
    {"CLI/", "CLI11"},
    {"hdf5.h", "HDF5"},
    {"matio.h", "matio"},
    {"openssl/", "OpenSSL"},
    {"Eigen/", "Eigen"},
    {"unsupported/Eigen/", "Eigen"},
    {"fast_float/", "fast_float"},
    {"boost/", "Boost"},
    {"zip.h", "libzip"},
    {"seccomp.h", "libseccomp"},
    {"zlib.h", "zlib"},
    {"expat.h", "expat"},
    {"sqlite3.h", "SQLite"},
    {"zstd.h", "zstd"},
    {"libpq-fe.h", "libpq"},
    {"nats/nats.h", "NATS"},
    {"curl/", "libcurl"},
    {"modbus/modbus.h", "libmodbus"},
    {"MQTTClient.h", "Paho"},
    {"net/if.h", "POSIX"},
    {"pybind11/", "pybind11"},
    {"arpa/", "POSIX"},
    {"netinet/", "POSIX"},
    {"poll.h", "POSIX"},
    {"spawn.h", "POSIX"},
    {"sys/", "POSIX"},
    {"linux/", "Linux"},
    {"unistd.h", "POSIX"},
    {"termios.h", "POSIX"},
    {"fcntl.h", "POSIX"},
    {"pthread.h", "POSIX"},
}};

/// As the table names it: "rig/plant" of "spoolflow/rig/plant/solenoid.hpp", "addons/live" of "addons/live/engine.hpp".
std::string folder_of(const fs::path& place) {
  const fs::path folder = place.parent_path();
  return (*place.begin() == "addons" ? folder : folder.lexically_relative("spoolflow")).generic_string();
}

class Checker {
 public:
  Checker(const FolderTable& table, std::vector<std::string>& violations) : table_(table), violations_(violations) {}

  void file(const fs::path& root, const fs::path& path) {
    place_ = fs::relative(path, root).generic_string();
    const std::string folder = folder_of(place_);
    const std::string row = row_of(table_, folder);
    if (row.empty()) {
      violations_.push_back(fmt::format("{}: the folder {} is not in the table", place_, folder));
      return;
    }
    const FolderRule& rule = table_.at(row);
    static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::ifstream in(path);
    line_ = 0;
    for (std::string text; std::getline(in, text);) {
      ++line_;
      std::smatch match;
      if (!std::regex_search(text, match, include)) continue;
      if (match[1] == "\"") {
        own_header(row, rule, match[2], root);
      } else {
        library_header(row, rule, match[2]);
      }
    }
  }

 private:
  void violation(const std::string& what) { violations_.push_back(fmt::format("{}:{}: {}", place_, line_, what)); }

  void own_header(const std::string& folder, const FolderRule& rule, const std::string& header, const fs::path& root) {
    const fs::path path(header);
    if ((*path.begin() != "spoolflow" && *path.begin() != "addons") || !fs::exists(root / path)) {
      violation(fmt::format("\"{}\" is no path from the project's root", header));
      return;
    }
    const std::string other = row_of(table_, folder_of(header));
    if (other == folder || allows(rule, other)) return;
    violation(fmt::format("{} must not include {} ({})", folder, other, header));
  }

  void library_header(const std::string& folder, const FolderRule& rule, const std::string& header) {
    const std::optional<std::string> library = library_of(header);
    if (!library) {
      violation(fmt::format("<{}> belongs to no library of the table", header));
    } else if (*library == "std") {
      if (rule.freestanding && !freestanding_headers.contains(header)) {
        violation(fmt::format("{} is freestanding and must not include <{}>", folder, header));
      }
    } else if (!rule.libraries.contains(*library)) {
      violation(fmt::format("{} must not use {} (<{}>)", folder, *library, header));
    }
  }

  const FolderTable& table_;
  std::vector<std::string>& violations_;
  std::string place_;
  int line_ = 0;
};

}  // namespace

std::optional<std::string> library_of(const std::string& header) {
  for (const auto& [prefix, library] : library_prefixes) {
    if (header.starts_with(prefix)) return std::string(library);
  }
  static const std::set<std::string> c_headers{"math.h", "signal.h"};
  const bool standard = header.find_first_of("./") == std::string::npos || c_headers.contains(header);
  return standard ? std::optional<std::string>("std") : std::nullopt;
}

std::vector<std::string> include_violations(const FolderTable& table, const fs::path& root) {
  std::vector<std::string> violations;
  Checker checker(table, violations);
  for (const fs::path& source : sources_below(root)) checker.file(root, source);
  std::sort(violations.begin(), violations.end());
  return violations;
}

}  // namespace spoolflow::architecture
