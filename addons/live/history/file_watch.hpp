#pragma once
/// Whether the file on which a database works is still the one that it opened: others may delete, replace, cut off or
/// overwrite it meanwhile, which SQLite itself does not report, or only once it reads there.
#include <cstdint>
#include <optional>
#include <string>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// A file behind a name.
struct FileIdentity {
  std::uint64_t device = 0, node = 0;
  std::int64_t bytes = 0;

  [[nodiscard]] bool is(const FileIdentity& other) const { return device == other.device && node == other.node; }
};
/// Nothing where there is no such file.
[[nodiscard]] std::optional<FileIdentity> identity_of(const std::string& path);

class FileWatch {
 public:
  enum class Found : std::uint8_t {
    same,
    gone,      ///< deleted: what it held is there as long as the database is open
    replaced,  ///< another file has its name: likewise
    log_gone,  ///< the log beside it (-wal) was deleted or replaced: likewise
    damaged,   ///< it has become shorter, or does not begin as a database does
  };

  /// Of an open database that has been written to.
  explicit FileWatch(const Database& database);
  [[nodiscard]] Found look(const Database& database);
  /// Whether the log that bears its name is still that of the open database.
  [[nodiscard]] bool has_log(const Database& database) const;

 private:
  std::optional<FileIdentity> file_, log_;
};

}  // namespace spoolflow::live
