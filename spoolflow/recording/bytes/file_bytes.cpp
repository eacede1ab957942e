#include "spoolflow/recording/bytes/file_bytes.hpp"

#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

FileBytes::FileBytes(const std::filesystem::path& file)
    : name_(file.string()), descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const std::string why = std::generic_category().message(errno);
    if (descriptor_ >= 0) ::close(descriptor_);
    throw RecordingError(fmt::format("{}: cannot be opened: {}; check the name and the permissions", name_, why));
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileBytes::~FileBytes() {
  ::close(descriptor_);
}

void FileBytes::read(std::uint64_t at, std::span<std::uint8_t> out) const {
  if (!holds(at, out.size())) {
    throw RecordingError(fmt::format(
        "{}: is cut short or damaged: it has {} bytes, but {} are said to stand at byte {}; copy or record it again",
        name_, size_, out.size(), at));
  }
  while (!out.empty()) {
    const ::ssize_t got = ::pread(descriptor_, out.data(), out.size(), static_cast<::off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      throw std::runtime_error(fmt::format("{}: reading failed at byte {}: {}", name_, at,
                                           got < 0 ? std::generic_category().message(errno) : "it became shorter"));
    }
    at += static_cast<std::uint64_t>(got);
    out = out.subspan(static_cast<std::size_t>(got));
  }
}

}  // namespace spoolflow::recording
