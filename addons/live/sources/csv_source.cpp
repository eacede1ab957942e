#include "addons/live/sources/csv_source.hpp"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "addons/live/sources/peer.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {
namespace {

constexpr int look_up_ms = 100;
/// Callers who may not send that are closed before the connection that serves is looked at again.
constexpr int most_strangers_at_once = 16;
constexpr const char* nobody = "nobody is connected";
/// A sender sends its line of names at once.
constexpr std::int64_t names_within_ns = 1'000'000'000;

}  // namespace

TcpSource::TcpSource(const Address& address, std::vector<std::string> allowed, recording::ReadOptions options,
                     SourcePosition after, Intake& intake)
    : socket_(bind_socket(address, Transport::tcp)),
      allowed_(std::move(allowed)),
      options_(std::move(options)),
      next_(after.next),
      intake_(intake) {
  options_.runs_on = true;
  intake_.set_trouble(nobody);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

/// Takes the newest caller that may send; waits for one at most `patience_ms`.
void TcpSource::answer_callers(int patience_ms) {
  for (int k = 0; k < most_strangers_at_once; ++k) {
    pollfd waiting{socket_.descriptor.number(), POLLIN, 0};
    if (::poll(&waiting, 1, k == 0 ? patience_ms : 0) <= 0) return;
    sockaddr_storage peer{};
    socklen_t length = sizeof peer;
    Descriptor connection(
        ::accept4(socket_.descriptor.number(), reinterpret_cast<sockaddr*>(&peer), &length, SOCK_CLOEXEC));
    if (connection.number() < 0) {
      if (errno != EMFILE && errno != ENFILE) return;
      // The caller stays in the queue of the socket, which stays readable: without a pause this would keep a core busy.
      intake_.set_trouble("a connection waits, and the process may open no more files; raise its limit (LimitNOFILE)");
      std::this_thread::sleep_for(std::chrono::milliseconds(patience_ms));
      return;
    }
    if (may_send(allowed_, peer)) {
      caller_ = {std::move(connection), peer_host(peer)};
      return;
    }
    intake_.set_trouble(fmt::format("{} tried to connect and is not allowed to", peer_host(peer)));
  }
}

void TcpSource::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (caller_.connection.number() < 0) answer_callers(look_up_ms);
    if (caller_.connection.number() < 0) continue;
    Caller serves = std::exchange(caller_, {});
    intake_.count_connection();
    const std::string host = serves.host;
    const std::int64_t connected_ns = steady_ns();
    bool names_missed = false;
    const auto given_up = [&] {
      if (!names_missed && steady_ns() - connected_ns > names_within_ns) {
        names_missed = true;
        if (intake_.trouble() == nobody)
          intake_.set_trouble(fmt::format("{} is connected and has sent no line of names yet", host));
      }
      if (caller_.connection.number() < 0) answer_callers(0);
      return stop.stop_requested() || caller_.connection.number() >= 0;
    };
    next_ =
        read_csv(std::make_unique<recording::InputBytes>(serves.connection.release(), std::move(serves.host), given_up),
                 options_, next_, intake_);
    if (intake_.trouble().empty()) intake_.set_trouble(nobody);
  }
}

PipeSource::PipeSource(std::filesystem::path path, recording::ReadOptions options, SourcePosition after, Intake& intake)
    : path_(std::move(path)), options_(std::move(options)), next_(after.next), intake_(intake) {
  options_.runs_on = true;
  struct stat status {};
  if (path_ != "-" && (::stat(path_.c_str(), &status) != 0 || !S_ISFIFO(status.st_mode))) {
    throw SiteError(
        fmt::format("{}: is no pipe; make it with mkfifo, or replay a file with kind = \"replay\"", path_.string()));
  }
  intake_.set_trouble("nobody writes to the pipe");
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void PipeSource::run(const std::stop_token& stop) {
  const bool once = path_ == "-";
  const auto given_up = [&] { return stop.stop_requested(); };
  Descriptor held;  // until the pipe is open again: what a sender writes in between must find a reader, and stay
  while (!stop.stop_requested()) {
    const int opened =
        once ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (opened < 0) {
      intake_.set_trouble("the pipe cannot be opened");
      if (!parallel::wait_for(std::chrono::milliseconds(1000), stop) || once) return;
      continue;
    }
    held = Descriptor(::fcntl(opened, F_DUPFD_CLOEXEC, 0));
    intake_.count_connection();
    next_ =
        read_csv(std::make_unique<recording::InputBytes>(opened, path_.string(), given_up), options_, next_, intake_);
    if (intake_.trouble().empty()) intake_.set_trouble(once ? "standard input has ended" : "nobody writes to the pipe");
    if (once) return;
    parallel::wait_for(std::chrono::milliseconds(10), stop);  // a writer that ends at once must not keep a core busy
  }
}

}  // namespace spoolflow::live
