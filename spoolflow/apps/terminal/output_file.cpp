#include "spoolflow/apps/terminal/output_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <streambuf>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/apps/terminal/interruption.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw OutputError(fmt::format("cannot write {}: {}", target == "-" ? "standard output" : target.string(), reason));
}

std::string folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path().string() : std::string(".");
}

[[noreturn]] void refuse_errno(const fs::path& target, int error) {
  const std::string folder = folder_of(target);
  switch (error) {
    case EPIPE:
      throw ReaderGone();
    case ENOSPC:
    case EDQUOT:
      refuse(target, "the disk is full; free some space or write to another disk, then run again");
    case EFBIG:
      refuse(target,
             "the file grew past the size limit of this disk or shell (ulimit -f); raise it or write elsewhere");
    case ENOENT:
      refuse(target, fmt::format("the folder {} does not exist; create it or name another", folder));
    case ENOTDIR:
      refuse(target, fmt::format("{} is not a folder; name another", folder));
    case EACCES:
    case EPERM:
      refuse(target, fmt::format("no permission to write in the folder {}; name another or change its rights", folder));
    case EROFS:
      refuse(target, fmt::format("the folder {} is on a read-only disk; name another", folder));
    default:
      refuse(target, std::strerror(error));
  }
}

/// Sends a large buffer to a file descriptor and throws where the system refuses it.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(fs::path target) : target_(std::move(target)) { setp(buffer_.begin(), buffer_.end()); }

  void descriptor(int descriptor) { descriptor_ = descriptor; }
  void stands_for_stdout() { is_stdout_ = true; }
  void write_out() {
    write_all(pbase(), pptr());
    setp(buffer_.begin(), buffer_.end());
  }

 protected:
  int_type overflow(int_type next) override {
    write_out();
    return traits_type::eq_int_type(next, traits_type::eof()) ? traits_type::not_eof(next)
                                                              : sputc(traits_type::to_char_type(next));
  }
  int sync() override {
    write_out();
    return 0;
  }
  /// Large pieces go where they are to go without a copy.
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    constexpr std::streamsize large = 64 * 1024;
    if (size < large) return std::streambuf::xsputn(text, size);
    write_out();
    write_all(text, text + size);
    return size;
  }

 private:
  void write_all(const char* from, const char* end) const {
    if (is_stdout_ && from != end) interruption_output_state(OutputState::stream_begun);
    while (from != end) {
      const ssize_t written = ::write(descriptor_, from, static_cast<std::size_t>(end - from));
      if (written < 0 && errno != EINTR) refuse_errno(target_, errno);
      if (written > 0) from += written;
    }
  }

  fs::path target_;
  int descriptor_ = -1;
  bool is_stdout_ = false;
  std::array<char, std::size_t{256} * 1024> buffer_;
};

/// Reads and writes at places of a file descriptor.
class DescriptorPlaces : public recording::PlacedBytes {
 public:
  DescriptorPlaces(fs::path target, int descriptor) : target_(std::move(target)), descriptor_(descriptor) {}

  void write(std::uint64_t at, std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (written < 0 && errno != EINTR) refuse_errno(target_, errno);
      if (written <= 0) continue;
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      at += static_cast<std::uint64_t>(written);
    }
  }
  void read(std::uint64_t at, std::span<std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (got < 0 && errno != EINTR) refuse_errno(target_, errno);
      if (got < 0) continue;
      if (got == 0) break;
      bytes = bytes.subspan(static_cast<std::size_t>(got));
      at += static_cast<std::uint64_t>(got);
    }
    std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});  // behind the end
  }

 private:
  fs::path target_;
  int descriptor_;
};

std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

bool same_file(const fs::path& a, const fs::path& b) {
  if (a == "-" || b == "-") return false;
  std::error_code ignored;
  const auto full_name = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  return fs::equivalent(a, b, ignored) || full_name(a) == full_name(b);
}

void check_target(const fs::path& target, const std::vector<fs::path>& also_used) {
  if (target.empty()) throw OutputError("the output has no name; give a file name, or - for standard output");
  if (target == "-") return;
  const auto status = status_of(target);
  if ((status && S_ISDIR(status->st_mode)) || !target.has_filename()) {
    refuse(target, fmt::format("it is a folder; name a file in it"));
  }
  const bool special = status && !S_ISREG(status->st_mode);
  for (const fs::path& other : also_used) {
    if (!special && same_file(target, other)) {
      refuse(target, fmt::format("this command also uses {}, which is the same file; name another", other.string()));
    }
  }
  if (status && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) {
    refuse(target, "the file is write-protected; name another or change its rights");
  }
}

/// Marks an unfinished file as somebody's for as long as its descriptor is open. False where another run that looked
/// whether it is anybody's removed it. File systems without locks keep every file.
bool keep(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

/// An unfinished file that nobody keeps is of a run that was killed.
void remove_if_left_behind(const fs::path& beside) {
  const int descriptor = ::open(beside.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status {};
  const bool left = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
                    ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (left) ::unlink(beside.c_str());
  ::close(descriptor);
}

/// Standard output, of one output at a time.
class StandardOutput {
 public:
  StandardOutput() {
    if (taken_.test_and_set())
      refuse("-", "another output of this command goes there, and the two would mix; name a file for one of them");
  }
  ~StandardOutput() { taken_.clear(); }
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

 private:
  inline static std::atomic_flag taken_;
};

}  // namespace

struct OutputFile::Target {
  explicit Target(const fs::path& asked) : name(asked), buffer(asked), stream(&buffer) {
    stream.exceptions(std::ios::badbit);  // lets the buffer's own exception through
  }

  void open_directly(int flags) {
    descriptor = ::open(name.c_str(), flags | O_CLOEXEC);
    if (descriptor < 0) refuse_errno(name, errno);
    buffer.descriptor(descriptor);
  }

  void open_beside(const std::optional<struct stat>& replaced) {
    std::error_code ignored;
    if (fs::is_symlink(name, ignored)) final_name = fs::weakly_canonical(name);
    constexpr std::size_t longest_name = 200;  // of 255 bytes that systems allow
    const std::string stem = final_name.filename().string().substr(0, longest_name);
    for (int attempt = 0; descriptor < 0; ++attempt) {
      const fs::path beside = fs::path(folder_of(final_name)) / fmt::format(".{}.spoolflow-{}.part", stem, attempt);
      remove_if_left_behind(beside);
      descriptor = ::open(beside.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0) {
        if (errno != EEXIST || attempt > 1000) refuse_errno(name, errno);
      } else if (keep(descriptor)) {
        unfinished.emplace(beside.string());  // from here on an interruption may remove it: it is no other run's
        kept_by = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
      } else {
        ::close(std::exchange(descriptor, -1));
      }
    }
    if (replaced) {
      // The new file takes over the old one's rights; where that is not permitted it has those of any new file.
      [[maybe_unused]] const bool kept = ::fchown(descriptor, replaced->st_uid, replaced->st_gid) == 0 &&
                                         ::fchmod(descriptor, replaced->st_mode & 07777) == 0;
    }
    buffer.descriptor(descriptor);
  }

  void close() {
    if (descriptor > STDOUT_FILENO && ::close(std::exchange(descriptor, -1)) != 0 && errno != EINTR) {
      refuse_errno(name, errno);
    }
  }

  fs::path name;
  fs::path final_name = name;
  int descriptor = -1;
  int kept_by = -1;  ///< keeps the unfinished file after `descriptor` is closed, until it has its name
  std::optional<UnfinishedFile> unfinished;
  DescriptorBuffer buffer;
  std::ostream stream;
  std::optional<DescriptorPlaces> places;
  std::optional<StandardOutput> standard_output;
};

OutputFile::OutputFile(const fs::path& target, const std::vector<fs::path>& also_used) {
  check_target(target, also_used);
  target_ = std::make_unique<Target>(target);
  const auto status = status_of(target);
  if (target == "-") {
    target_->standard_output.emplace();
    target_->descriptor = STDOUT_FILENO;
    target_->buffer.descriptor(STDOUT_FILENO);
    target_->buffer.stands_for_stdout();
  } else if (status && !S_ISREG(status->st_mode)) {
    target_->open_directly(O_WRONLY);
  } else {
    target_->open_beside(status);
  }
}

OutputFile::~OutputFile() {
  if (target_->descriptor > STDOUT_FILENO) ::close(target_->descriptor);
  if (target_->unfinished) ::unlink(target_->unfinished->path().c_str());
  if (target_->kept_by >= 0) ::close(target_->kept_by);
}

std::ostream& OutputFile::stream() {
  return target_->stream;
}

recording::PlacedBytes& OutputFile::in_places() {
  if (!target_->unfinished)
    refuse(target_->name, "this format is not written from front to back, so it needs a file; name one");
  if (!target_->places) target_->places.emplace(target_->name, target_->descriptor);
  return *target_->places;
}

recording::PlacedBytes& OutputFile::scratch() {
  if (!target_->unfinished) return in_places();  // which refuses
  if (!scratch_) scratch_ = std::make_unique<OutputFile>(target_->name);
  return scratch_->in_places();
}

void OutputFile::finish() {
  target_->buffer.write_out();
  target_->close();
}

void OutputFile::commit() {
  finish();
  scratch_.reset();
  if (!target_->unfinished) return;
  const InterruptionPause pause;
  if (::rename(target_->unfinished->path().c_str(), target_->final_name.c_str()) != 0) {
    refuse_errno(target_->name, errno);
  }
  target_->unfinished.reset();
  interruption_output_state(OutputState::file_finished);
}

OutputFile& Outputs::open(const fs::path& target) {
  files_.push_back(std::make_unique<OutputFile>(target, used_));
  used_.push_back(target);
  return *files_.back();
}

void Outputs::commit() {
  for (const auto& file : files_) file->finish();
  for (const auto& file : files_) file->commit();
}

void make_output_folder(const fs::path& folder) {
  if (folder == "-") throw OutputError("cannot make the folder -: files go into a folder; name one after -o");
  std::error_code error;
  fs::create_directories(folder, error);
  std::error_code unreadable;
  if (fs::is_directory(folder, unreadable)) return;
  const std::string reason = fs::exists(folder, unreadable) ? "a file of that name is there" : error.message();
  throw OutputError(fmt::format("cannot make the folder {}: {}; name another", folder.string(), reason));
}

void keep_what_is_there(const fs::path& folder, const std::vector<std::string>& names, const std::string& command) {
  for (const std::string& name : names) {
    std::error_code unreadable;
    if (!fs::exists(folder / name, unreadable)) continue;
    refuse(folder / name,
           fmt::format("it is there already and comes from no earlier {}; move it, or name another folder", command));
  }
}

}  // namespace spoolflow::apps
