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

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t longest_message = std::uint64_t{64} << 20;

struct Head {
  std::uint32_t kind;
  std::uint32_t unused;
  std::uint64_t length;
};

bool send_all(int descriptor, const char* from, std::size_t count) {
  while (count > 0) {
    const ::ssize_t written = ::send(descriptor, from, count, MSG_NOSIGNAL);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    from += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

bool receive_all(int descriptor, char* to, std::size_t count) {
  while (count > 0) {
    const ::ssize_t got = ::read(descriptor, to, count);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

/// The child's whole life.
[[noreturn]] void live(int descriptor, const ReadingLimits& limits, const std::function<void(Connection&)>& work,
                       const sigset_t& before) {
  constexpr int done = 0, failed = 1;
  // Interruptions are the parent's, which ends the child by going; its handlers would speak of the parent's files.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(number, SIG_IGN);
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGXFSZ}) std::signal(number, SIG_DFL);
  (void)::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  try {
    give_up_rights(descriptor, limits);
    Connection connection(descriptor);
    work(connection);
  } catch (...) {
    ::_exit(failed);
  }
  ::_exit(done);
}

}  // namespace

bool Connection::send(std::uint32_t kind, std::string_view content) {
  const Head head{kind, 0, content.size()};
  std::array<char, sizeof head> bytes{};
  std::memcpy(bytes.data(), &head, sizeof head);
  return send_all(descriptor_, bytes.data(), bytes.size()) && send_all(descriptor_, content.data(), content.size());
}

bool Connection::receive(std::uint32_t& kind, std::string& content) {
  std::array<char, sizeof(Head)> bytes{};
  if (!receive_all(descriptor_, bytes.data(), bytes.size())) return false;
  Head head{};
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.length > longest_message) return false;
  kind = head.kind;
  content.resize(static_cast<std::size_t>(head.length));
  return receive_all(descriptor_, content.data(), content.size());
}

ReadingProcess::ReadingProcess(const ReadingLimits& limits, const std::function<void(Connection&)>& work)
    : limits_(limits) {
  std::array<int, 2> ends{-1, -1};
  const auto refuse = [](const char* what) {
    throw std::runtime_error(
        fmt::format("no process can be started to read the recording: {}: {}", what, std::strerror(errno)));
  };
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) refuse("no connection");
  sigset_t all, before;  // no handler of this process may run in the child
  sigfillset(&all);
  (void)::pthread_sigmask(SIG_SETMASK, &all, &before);
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[0]);
    live(ends[1], limits, work, before);
  }
  const int failure = errno;
  (void)::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[1]);
  descriptor_ = ends[0];
  connection_ = Connection(descriptor_);
  if (child_ < 0) {
    ::close(descriptor_);
    errno = failure;
    refuse("no further process");
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
