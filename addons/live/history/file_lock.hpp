#pragma once
/// One program at a time on a store. The lock lies on the file itself, beyond all that SQLite locks: a program that
/// comes by another name of it (a symbolic or a hard link) meets it, too.
#include <string>

namespace spoolflow::live {

class FileLock {
 public:
  /// Makes the file where there is none. Throws StoreError: its folder does not exist, it or its folder may not be
  /// written to, another program holds it.
  explicit FileLock(const std::string& path);
  /// Behind the database that it is for: a process that closes a file gives up SQLite's locks on it.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// Behind all symbolic links: there SQLite has its log, and there a store that was deleted is written again. The name
/// as it is where there is no such file.
[[nodiscard]] std::string real_name(const std::string& path);

}  // namespace spoolflow::live
