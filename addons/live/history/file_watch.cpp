#include "addons/live/history/file_watch.hpp"

#include <algorithm>
#include <sys/stat.h>

namespace spoolflow::live {

std::optional<FileIdentity> identity_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileIdentity{static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino),
                      static_cast<std::int64_t>(found.st_size)};
}

FileWatch::FileWatch(const Database& database)
    : file_(identity_of(database.path())), log_(identity_of(database.path() + "-wal")) {}

FileWatch::Found FileWatch::look(const Database& database) {
  const auto file = identity_of(database.path());
  if (!file) return Found::gone;
  if (!file_ || !file->is(*file_)) return Found::replaced;
  if (file->bytes < file_->bytes || !database.begins_as_database()) return Found::damaged;
  file_ = file;
  const auto log = identity_of(database.path() + "-wal");
  if (!log_) log_ = log;  // it begins with the first that is written
  return log_ && (!log || !log->is(*log_)) ? Found::log_gone : Found::same;
}

bool FileWatch::has_log(const Database& database) const {
  const auto log = identity_of(database.path() + "-wal");
  return log && log_ && log->is(*log_);
}

}  // namespace spoolflow::live
