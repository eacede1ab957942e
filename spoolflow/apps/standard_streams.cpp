#include "spoolflow/apps/standard_streams.hpp"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace spoolflow::apps {

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
