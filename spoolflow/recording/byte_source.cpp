#include "spoolflow/recording/byte_source.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t first_size = std::size_t{1} << 18;
constexpr std::size_t longest_line = std::size_t{1} << 24;

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& file)
    : name_(file == "-" ? "standard input" : file.string()),
      descriptor_(file == "-" ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC)),
      buffer_(first_size) {
  if (descriptor_ < 0) {
    throw RecordingError(fmt::format("{}: cannot be opened ({}); check the path", name_, std::strerror(errno)));
  }
  struct stat about {};
  if (::fstat(descriptor_, &about) == 0) {
    if (S_ISDIR(about.st_mode)) {
      if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
      throw RecordingError(fmt::format("{}: is a folder, not a recording", name_));
    }
    if (S_ISREG(about.st_mode)) size_ = static_cast<std::uint64_t>(about.st_size);
  }
}

ByteSource::~ByteSource() {
  if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
}

bool ByteSource::refill() {
  if (at_end_) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {
    if (buffer_.size() >= longest_line) {
      throw RecordingError(
          fmt::format("{}: a line is longer than {} MiB; this is no text file of rows", name_, longest_line >> 20));
    }
    buffer_.resize(2 * buffer_.size());
  }
  ssize_t got = 0;
  do {
    got = ::read(descriptor_, buffer_.data() + end_, buffer_.size() - end_);
  } while (got < 0 && errno == EINTR);
  if (got < 0) throw RecordingError(fmt::format("{}: cannot be read ({})", name_, std::strerror(errno)));
  if (got == 0) {
    at_end_ = true;
    return false;
  }
  end_ += static_cast<std::size_t>(got);
  read_ += static_cast<std::uint64_t>(got);
  return true;
}

bool ByteSource::next_line(std::string_view& line) {
  std::size_t searched = 0;
  while (true) {
    const char* const from = buffer_.data() + begin_ + searched;
    const void* const found = end_ > begin_ + searched ? std::memchr(from, '\n', end_ - begin_ - searched) : nullptr;
    if (found != nullptr) {
      const char* const stop = static_cast<const char*>(found);
      const char* const start = buffer_.data() + begin_;
      line = {start, static_cast<std::size_t>(stop - start)};
      begin_ = static_cast<std::size_t>(stop - buffer_.data()) + 1;
      break;
    }
    searched = end_ - begin_;
    if (refill()) continue;
    if (begin_ == end_) return false;
    line = {buffer_.data() + begin_, end_ - begin_};
    begin_ = end_;
    break;
  }
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

std::optional<double> ByteSource::progress() const {
  if (size_ == 0) return std::nullopt;
  return static_cast<double>(read_ - (end_ - begin_)) / static_cast<double>(size_);
}

}  // namespace spoolflow::recording
