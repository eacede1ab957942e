#include "spoolflow/recording/files/reading_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "spoolflow/recording/files/fork_server.hpp"

namespace spoolflow::recording {
namespace {

[[noreturn]] void refuse(std::string_view what) {
  throw std::runtime_error(fmt::format("no process can be started to read the recording: {}", what));
}

/// The child, or -1 and errno.
::pid_t fork_reader(const ReadingOrder& order, int connection) {
  sigset_t all, before;  // no handler of this process may run in the child
  sigfillset(&all);
  (void)::pthread_sigmask(SIG_SETMASK, &all, &before);
  const ::pid_t child = ::fork();
  if (child == 0) {
    settle_signals(before);
    live_as_reader(order, connection);
  }
  const int failure = errno;
  (void)::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = failure;
  return child;
}

}  // namespace

ReadingProcess::ReadingProcess(const ReadingOrder& order) : limits_(order.limits) {
  ForkServer* const fork_server = ForkServer::present();
  if (fork_server == nullptr && !may_fork()) {
    refuse("this one has several threads and started none before them; was the file exchanged meanwhile?");
  }
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    refuse(fmt::format("no connection: {}", std::strerror(errno)));
  }
  child_ = fork_server != nullptr ? fork_server->start(order, ends[1]) : fork_reader(order, ends[1]);
  const int failure = errno;
  ::close(ends[1]);
  descriptor_ = ends[0];
  connection_ = Connection(descriptor_);
  if (child_ < 0) {
    ::close(descriptor_);
    refuse(fmt::format("no further process: {}", std::strerror(failure)));
  }
}

ReadingProcess::~ReadingProcess() {
  ::close(descriptor_);
  if (child_ <= 0) return;
  (void)::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::string ReadingProcess::end() {
  int status = 0;
  ::pid_t ended = 0;
  for (int waited_ms = 0; ended == 0 || (ended < 0 && errno == EINTR); ++waited_ms) {
    if (waited_ms == 1000) (void)::kill(child_, SIGKILL);  // it lives on with its connection closed
    ended = child_ > 0 ? ::waitpid(child_, &status, WNOHANG) : -1;
    if (ended == 0) ::usleep(1000);
  }
  child_ = -1;
  if (ended < 0 || !WIFSIGNALED(status)) return "ended before it had read it";
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return fmt::format("needed more than {} s of computing", limits_.computing_s);
  if (signal == SIGKILL) return "was ended from outside, perhaps for want of memory";
  return fmt::format("crashed on it ({})", ::strsignal(signal));
}

}  // namespace spoolflow::recording
