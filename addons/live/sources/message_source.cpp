#include "addons/live/sources/message_source.hpp"

#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

#include <fmt/format.h>

#include "addons/live/sources/message_text.hpp"

namespace spoolflow::live {
namespace {

constexpr int patience_ms = 1000;
constexpr int buffered_bytes = 1 << 20;

}  // namespace

MessageSource::MessageSource(std::string name, recording::ReadOptions options, SourcePosition after, Intake& intake)
    : name_(std::move(name)), options_(std::move(options)), next_(after.next), intake_(intake) {
  options_.runs_on = true;
  intake_.set_trouble("no message has come");
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void MessageSource::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Descriptor reads;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return waiting_.number() >= 0; })) return;
      reads = std::exchange(waiting_, Descriptor());
    }
    changed_.notify_all();
    const auto given_up = [&] { return stop.stop_requested(); };
    next_ =
        read_csv(std::make_unique<recording::InputBytes>(reads.release(), name_, given_up), options_, next_, intake_);
  }
}

bool MessageSource::begin(const std::string& header) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    intake_.set_trouble("the process may open no more files; raise its limit (LimitNOFILE)");
    return false;
  }
  Descriptor reads(ends[0]);
  writer_ = Descriptor(ends[1]);
  (void)::setsockopt(ends[1], SOL_SOCKET, SO_SNDBUF, &buffered_bytes, sizeof buffered_bytes);
  {
    std::unique_lock lock(mutex_);
    const auto is_free = [this] { return waiting_.number() < 0; };
    if (!changed_.wait_for(lock, std::chrono::milliseconds(patience_ms), is_free)) return false;
    waiting_ = std::move(reads);
  }
  changed_.notify_all();
  intake_.count_connection();
  header_ = header;
  return write(header_ + '\n') == Written::whole;
}

MessageSource::Written MessageSource::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t sent = ::send(writer_.number(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent >= 0) {
      text.remove_prefix(static_cast<std::size_t>(sent));
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return Written::nobody_reads;
    pollfd room{writer_.number(), POLLOUT, 0};
    if (::poll(&room, 1, patience_ms) == 0) return Written::no_room;
  }
  return Written::whole;
}

void MessageSource::take(std::string_view message) {
  MessageText text;
  try {
    text = message_text(message);
    if (text.header.empty() && header_.empty())
      throw std::invalid_argument("its rows stand below no header; begin messages with a line that names the columns");
  } catch (const std::invalid_argument& error) {
    intake_.count_unreadable(1);
    intake_.set_trouble(fmt::format("a message cannot be read: {}", error.what()));
    was_unreadable_ = true;
    return;
  }
  if (std::exchange(was_unreadable_, false)) intake_.set_trouble({});
  const std::string header = text.header.empty() ? header_ : text.header;
  bool begins = writer_.number() < 0 || header != header_;
  for (int tries = 0; tries < 2; ++tries) {
    if (begins && !begin(header)) break;
    const Written written = write(text.rows);
    if (written == Written::whole) return;
    if (written == Written::no_room) break;
    begins = true;  // its reader met a header that cannot be used, or it ended for another reason
  }
  writer_ = Descriptor();
  intake_.count_dropped(text.samples);
}

}  // namespace spoolflow::live
