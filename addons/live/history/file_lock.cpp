#include "addons/live/history/file_lock.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

#include <fmt/format.h>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {
namespace {

/// SQLite's own locks lie at 1 GiB.
constexpr off_t locked_byte = off_t{1} << 62U;

/// Throws StoreError, of the name that may not be written to.
void check_rights(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto refuse = [&](const std::string& name) {
    throw StoreError(fmt::format("{}: {} may not be written to ({}); change its rights, or name another store", path,
                                 name, std::strerror(errno)));
  };
  for (const char* const end : {"", "-wal", "-shm"}) {
    const std::string name = path + end;
    if (::faccessat(AT_FDCWD, name.c_str(), W_OK, AT_EACCESS) != 0 && errno != ENOENT) refuse(name);
  }
  const std::string where = folder.empty() ? "." : folder;
  if (::faccessat(AT_FDCWD, where.c_str(), W_OK | X_OK, AT_EACCESS) != 0) refuse("its folder " + where);
}

}  // namespace

FileLock::FileLock(const std::string& path) : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) {
    throw StoreError(
        errno == ENOENT || errno == ENOTDIR
            ? fmt::format("{}: its folder does not exist; make it, or name another store", path)
            : fmt::format("{}: may not be written to ({}); change the rights of file and folder, or name another store",
                          path, std::strerror(errno)));
  }
  try {
    check_rights(real_name(path));
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = locked_byte;
    lock.l_len = 1;
    if (::fcntl(descriptor_, F_OFD_SETLK, &lock) == 0) return;
    throw StoreError(
        errno == EAGAIN || errno == EACCES
            ? fmt::format("{}: another spoolflow live is running on it; end that or name another store", path)
            : fmt::format("{}: cannot be locked ({}); name a store on another disk", path, std::strerror(errno)));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

FileLock::~FileLock() {
  ::close(descriptor_);
}

std::string real_name(const std::string& path) {
  std::error_code none;
  const std::filesystem::path real = std::filesystem::canonical(path, none);
  return none ? path : real.string();
}

}  // namespace spoolflow::live
