#include "spoolflow/apps/terminal/terminal_text.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "spoolflow/apps/terminal/output_file.hpp"

namespace spoolflow::apps {
namespace {

[[noreturn]] void refuse_standard_output() {
  if (errno == EPIPE) throw ReaderGone();
  if (errno == EBADF)
    throw OutputError("cannot write standard output: it is closed; send it somewhere, or to /dev/null");
  throw OutputError(fmt::format("cannot write standard output: {}", std::strerror(errno)));
}

}  // namespace

void print_text(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) refuse_standard_output();
}

void say_text(std::string_view text) {
  [[maybe_unused]] const std::size_t written = std::fwrite(text.data(), 1, text.size(), stderr);
}

void flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) refuse_standard_output();
}

void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor is this one. Opened the wrong way round, so that its use is an error.
    const int held = ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (held >= 0 && held != stream) {
      (void)::dup2(held, stream);
      ::close(held);
    }
  }
}

}  // namespace spoolflow::apps
