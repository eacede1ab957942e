#include "spoolflow/export/cpp/overwriting.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

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

/// Each is in folders of its own kind alone: the model for C++, the library for C.
constexpr std::array<std::string_view, 2> made_for{cpp_model_name, "libvalve_sensor.a"};

/// What the folder holds of an export of the other kind; empty: nothing.
std::string_view of_another_kind(const std::map<std::string, std::string>& record,
                                 const std::vector<ExportedFile>& files) {
  for (const std::string_view kind : made_for) {
    if (record.contains(std::string(kind)) && std::ranges::find(files, kind, &ExportedFile::name) == files.end())
      return kind;
  }
  return {};
}

}  // namespace

std::string why_not_to_overwrite(const fs::path& folder, const std::vector<ExportedFile>& files) {
  const std::map<std::string, std::string> record = record_of(folder);
  if (const std::string_view other = of_another_kind(record, files); !other.empty()) {
    return fmt::format(
        "cannot export into {}: {} there is of an export of another kind, whose files have the same "
        "names; name another folder",
        folder.string(), other);
  }
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
