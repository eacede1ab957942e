#include "spoolflow/recording/files/fork_server.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <linux/sched.h>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <type_traits>
#include <unistd.h>

namespace spoolflow::recording {
namespace {

std::atomic<ForkServer*> the_fork_server{nullptr};

// An order is one message of a socket that keeps messages apart: this, the bytes, and the descriptors beside them.
struct OrderHead {
  ReadingOrder::Work work;
  ReadingLimits limits;
};
static_assert(std::is_trivially_copyable_v<OrderHead>);
constexpr std::size_t most_bytes = 8192;  ///< of an order: a path has up to 4096

struct Answer {
  ::pid_t child;
  int failure;  ///< errno
};

/// Descriptors as they travel beside a message.
struct Passage {
  alignas(cmsghdr) std::array<char, CMSG_SPACE(2 * sizeof(int))> room{};
};

bool send_order(int socket, const ReadingOrder& order, int connection) {
  OrderHead head{order.work, order.limits};
  std::string bytes = order.bytes;
  std::array<iovec, 2> parts{{{&head, sizeof head}, {bytes.data(), bytes.size()}}};
  const std::array<int, 2> descriptors{connection, order.memory};
  const std::size_t size = (order.memory < 0 ? 1 : 2) * sizeof(int);
  Passage passage;
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  message.msg_control = passage.room.data();
  message.msg_controllen = CMSG_SPACE(size);
  cmsghdr* const beside = CMSG_FIRSTHDR(&message);
  beside->cmsg_level = SOL_SOCKET;
  beside->cmsg_type = SCM_RIGHTS;
  beside->cmsg_len = CMSG_LEN(size);
  std::memcpy(CMSG_DATA(beside), descriptors.data(), size);
  ::ssize_t sent = -1;
  do sent = ::sendmsg(socket, &message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent >= 0;
}

/// The order and its connection, which is -1 where there was no room for descriptors. Ends the process once nobody can
/// order any more.
int receive_order(int socket, ReadingOrder& order) {
  OrderHead head{};
  order.bytes.resize(most_bytes);
  std::array<iovec, 2> parts{{{&head, sizeof head}, {order.bytes.data(), order.bytes.size()}}};
  Passage passage;
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  message.msg_control = passage.room.data();
  message.msg_controllen = passage.room.size();
  ::ssize_t got = -1;
  do got = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  while (got < 0 && errno == EINTR);
  if (got < static_cast<::ssize_t>(sizeof head)) ::_exit(0);
  order.work = head.work;
  order.limits = head.limits;
  order.bytes.resize(static_cast<std::size_t>(got) - sizeof head);
  std::array<int, 2> descriptors{-1, -1};
  const cmsghdr* const beside = CMSG_FIRSTHDR(&message);
  if (beside != nullptr) std::memcpy(descriptors.data(), CMSG_DATA(beside), beside->cmsg_len - CMSG_LEN(0));
  order.memory = descriptors[1];
  if ((message.msg_flags & MSG_CTRUNC) == 0) return descriptors[0];
  for (const int descriptor : descriptors) {
    if (descriptor >= 0) ::close(descriptor);
  }
  return -1;
}

/// As fork(), of this process's only thread; the child's parent is this process's own, which ends it and learns its
/// end.
::pid_t fork_sibling() {
  return static_cast<::pid_t>(::syscall(SYS_clone, CLONE_PARENT | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

/// The fork server's whole life.
[[noreturn]] void tend(int socket) {
  keep_only({socket, -1});
  for (;;) {
    ReadingOrder order{};
    const int connection = receive_order(socket, order);
    Answer answer{-1, EMFILE};
    if (connection >= 0) {
      answer.child = fork_sibling();
      if (answer.child == 0) live_as_reader(order, connection);
      answer.failure = errno;
      ::close(connection);
      if (order.memory >= 0) ::close(order.memory);
    }
    if (::send(socket, &answer, sizeof answer, MSG_NOSIGNAL) < 0) ::_exit(0);
  }
}

/// Zero where the system does not state it.
int threads() {
  std::ifstream status("/proc/self/status");
  int count = 0;
  for (std::string word; status >> word;) {
    if (word == "Threads:") status >> count;
  }
  return count;
}

}  // namespace

bool may_fork() {
  for (int waited_ms = 0; threads() > 1; ++waited_ms) {
    if (waited_ms == 1000) return false;
    ::usleep(1000);
  }
  return true;
}

ForkServer::ForkServer() {
  if (present() != nullptr) throw std::logic_error("there is a fork server of reading processes already");
  if (!may_fork()) throw std::logic_error("a fork server of reading processes is started before any further thread");
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0) {
    sigset_t all, before;  // no handler of this process may run in the fork server
    sigfillset(&all);
    (void)::pthread_sigmask(SIG_SETMASK, &all, &before);
    process_ = ::fork();
    if (process_ == 0) {
      settle_signals(before);
      tend(ends[1]);
    }
    failure_ = errno;
    (void)::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::close(ends[1]);
    socket_ = ends[0];
  } else {
    failure_ = errno;
  }
  the_fork_server = this;
}

ForkServer::~ForkServer() {
  the_fork_server = nullptr;
  if (socket_ >= 0) ::close(socket_);
  if (process_ <= 0) return;
  (void)::kill(process_, SIGKILL);  // where it could not end by itself: stopped from outside
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

ForkServer* ForkServer::present() {
  return the_fork_server;
}

::pid_t ForkServer::start(const ReadingOrder& order, int connection) {
  const std::lock_guard lock(mutex_);
  errno = process_ > 0 ? ENAMETOOLONG : failure_;
  if (process_ <= 0 || order.bytes.size() > most_bytes || !send_order(socket_, order, connection)) return -1;
  Answer answer{-1, 0};
  ::ssize_t got = -1;
  do got = ::recv(socket_, &answer, sizeof answer, 0);
  while (got < 0 && errno == EINTR);
  if (got != sizeof answer) answer.failure = EPIPE;
  errno = answer.failure;
  return answer.child;
}

}  // namespace spoolflow::recording
