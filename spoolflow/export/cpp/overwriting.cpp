#include "spoolflow/export/cpp/overwriting.hpp"

#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "spoolflow/model/provenance.hpp"

namespace spoolflow::exports {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// SHA-256 by name of what the last export into a folder wrote; empty where there was none.
std::map<std::string, std::string> record_of(const fs::path& folder) {
  std::map<std::string, std::string> out;
  std::ifstream in(folder / cpp_record_name);
  for (std::string sum, name; in >> sum >> name;) out[name] = sum;
  return out;
}

}  // namespace

std::string why_not_to_overwrite(const fs::path& folder, const std::vector<ExportedFile>& files) {
  const std::map<std::string, std::string> record = record_of(folder);
  for (const ExportedFile& file : files) {
    const fs::path target = folder / file.name;
    std::error_code unreadable;
    if (file.name == cpp_record_name && !record.empty()) continue;
    if (fs::is_directory(target, unreadable)) {
      return fmt::format("cannot write {}: a folder has that name; move it, or name another folder", target.string());
    }
    if (!fs::exists(target, unreadable) || bytes_of(target) == file.content) continue;
    const auto exported = record.find(file.name);
    if (exported == record.end()) {
      return fmt::format("cannot write {}: it is there already and comes from no earlier export; name another folder",
                         target.string());
    }
    if (model::sha256_of_file(target) != exported->second) {
      return fmt::format(
          "cannot write {}: it was changed since it was exported; keep it under another name, or name another folder",
          target.string());
    }
  }
  return {};
}

}  // namespace spoolflow::exports
