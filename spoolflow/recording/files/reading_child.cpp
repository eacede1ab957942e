#include "spoolflow/recording/files/reading_child.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <sys/socket.h>
#include <unistd.h>

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

void settle_signals(const sigset_t& mask) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGTSTP}) std::signal(number, SIG_IGN);
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGXFSZ}) std::signal(number, SIG_DFL);
  (void)::pthread_sigmask(SIG_SETMASK, &mask, nullptr);
}

void live_as_reader(const ReadingOrder& order, int connection) {
  constexpr int done = 0, failed = 1;
  try {
    keep_only({connection, order.memory});
    give_up_rights(order.limits);
    Connection parent(connection);
    order.work(order, parent);
  } catch (...) {
    ::_exit(failed);
  }
  ::_exit(done);
}

}  // namespace spoolflow::recording
