#include "spoolflow/recording/files/input_bytes.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

InputBytes::InputBytes(const std::filesystem::path& file)
    : name_(file == "-" ? "standard input" : file.string()), descriptor_(STDIN_FILENO), owned_(file != "-") {
  if (owned_) {
    if (file.empty()) throw RecordingError("the name of the recording is empty; name a file, or - for standard input");
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) {
      throw RecordingError(
          fmt::format("{}: cannot be opened: {}; check the name and the permissions", name_, reason(errno)));
    }
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      if (owned_) ::close(descriptor_);
      throw RecordingError(fmt::format("{}: is a folder; name a file in it", name_));
    }
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
  }
}

InputBytes::InputBytes(int descriptor, std::string name, std::function<bool()> given_up)
    : name_(std::move(name)), descriptor_(descriptor), owned_(true), given_up_(std::move(given_up)) {}

/// False where it was given up.
bool InputBytes::wait() const {
  constexpr int look_up_ms = 100;
  while (!given_up_()) {
    pollfd waiting{descriptor_, POLLIN, 0};
    if (::poll(&waiting, 1, look_up_ms) > 0) return true;
  }
  return false;
}

InputBytes::~InputBytes() {
  if (owned_) ::close(descriptor_);
}

std::size_t InputBytes::read(char* out, std::size_t room) {
  std::size_t filled = 0;
  while (filled < room) {
    const std::size_t got = read_some(out + filled, room - filled);
    if (got == 0) break;
    filled += got;
  }
  return filled;
}

std::size_t InputBytes::read_some(char* out, std::size_t room) {
  for (;;) {
    if (given_up_ && !wait()) return 0;
    const ::ssize_t got = ::read(descriptor_, out, room);
    if (got >= 0) {
      position_ += static_cast<std::uint64_t>(got);
      return static_cast<std::size_t>(got);
    }
    if (errno == EINTR || (errno == EAGAIN && given_up_)) continue;
    if (errno == EBADF) throw RecordingError(fmt::format("{}: cannot be read: it is closed", name_));
    throw std::runtime_error(fmt::format("{}: reading failed after {} bytes: {}", name_, position_, reason(errno)));
  }
}

RepeatedInput::RepeatedInput(std::filesystem::path file) : file_(std::move(file)) {
  if (file_ != "-") return;
  std::string name = (std::filesystem::temp_directory_path() / "spoolflow-input-XXXXXX").string();
  copy_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (copy_ >= 0) ::unlink(name.c_str());
  InputBytes input("-");
  std::vector<char> bytes(std::size_t{1} << 16);
  for (std::size_t got = 1; got > 0;) {
    got = input.read_some(bytes.data(), bytes.size());
    for (std::size_t done = 0; done < got;) {
      const ::ssize_t now = copy_ < 0 ? -1 : ::write(copy_, bytes.data() + done, got - done);
      if (now >= 0) {
        done += static_cast<std::size_t>(now);
      } else if (copy_ < 0 || errno != EINTR) {
        const int error = errno;
        if (copy_ >= 0) ::close(copy_);
        throw std::runtime_error(fmt::format("standard input: no copy of it can be kept in {}: {}; save it as a file",
                                             std::filesystem::temp_directory_path().string(), reason(error)));
      }
    }
  }
}

RepeatedInput::~RepeatedInput() {
  if (copy_ >= 0) ::close(copy_);
}

std::unique_ptr<InputBytes> RepeatedInput::open() const {
  if (copy_ < 0) return std::make_unique<InputBytes>(file_);
  const int again = ::open(fmt::format("/proc/self/fd/{}", copy_).c_str(), O_RDONLY | O_CLOEXEC);
  if (again < 0) {
    throw std::runtime_error(
        fmt::format("standard input: its copy cannot be opened: {}; save it as a file", reason(errno)));
  }
  return std::make_unique<InputBytes>(again, "standard input", nullptr);
}

}  // namespace spoolflow::recording
