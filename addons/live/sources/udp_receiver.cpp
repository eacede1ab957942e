#include "addons/live/sources/udp_receiver.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "addons/live/sources/peer.hpp"

namespace spoolflow::live {
namespace {

constexpr int idle_ms = 100;
constexpr int receiver_niceness = -10;
constexpr std::size_t datagrams_together = 128;
constexpr auto pause = std::chrono::milliseconds(1);

/// Room for the datagrams of one call of the system. Of its pages those are in memory that were ever written to.
class Datagrams {
 public:
  Datagrams() : room_(std::make_unique_for_overwrite<std::uint8_t[]>(datagrams_together * largest_datagram)) {
    for (std::size_t k = 0; k < datagrams_together; ++k) {
      parts_[k] = {room_.get() + k * largest_datagram, largest_datagram};
      msghdr& header = heads_[k].msg_hdr;
      header.msg_iov = &parts_[k];
      header.msg_iovlen = 1;
      header.msg_name = &peers_[k];
    }
  }
  /// Those that wait at the socket; returns how many there are.
  std::size_t take(int socket) {
    for (mmsghdr& head : heads_) head.msg_hdr.msg_namelen = sizeof(sockaddr_storage);
    const int got = ::recvmmsg(socket, heads_.data(), datagrams_together, MSG_DONTWAIT, nullptr);
    return got < 0 ? 0 : static_cast<std::size_t>(got);
  }
  [[nodiscard]] std::span<const std::uint8_t> bytes(std::size_t k) const {
    return {room_.get() + k * largest_datagram, heads_[k].msg_len};
  }
  [[nodiscard]] const sockaddr_storage& peer(std::size_t k) const { return peers_[k]; }

 private:
  std::unique_ptr<std::uint8_t[]> room_;
  std::array<iovec, datagrams_together> parts_{};
  std::array<sockaddr_storage, datagrams_together> peers_{};
  std::array<mmsghdr, datagrams_together> heads_{};
};

}  // namespace

bool DatagramOrder::confirms_leap(const Datagram& datagram) {
  leap_datagrams_ = datagram.sequence == leap_next_ ? leap_datagrams_ + 1 : 1;
  leap_next_ = datagram.sequence + datagram.samples.size();
  if (leap_datagrams_ < confirming_datagrams) return false;
  leap_datagrams_ = 0;
  return true;
}

SampleBlock DatagramOrder::next(Datagram&& datagram, Intake& intake) {
  SampleBlock block{.arrived_ns = steady_ns()};
  if (!known_ || datagram.session != after_.session) {
    // The first of a session that is met may be in its middle: what was sent before the program ran is not lost by it.
    after_ = {datagram.session, datagram.sequence};
    known_ = true;
    leap_datagrams_ = 0;
    intake.count_connection();
  }
  const bool far_ahead = datagram.sequence > after_.next && datagram.sequence - after_.next > most_lost_at_once;
  const bool known_before = datagram.sequence + datagram.samples.size() <= after_.next;
  if (!far_ahead && !known_before) {
    leap_datagrams_ = 0;
  } else if (confirms_leap(datagram)) {
    if (known_before || datagram.sequence - after_.next > most_lost) {
      intake.count_connection();
      after_.next = datagram.sequence;
    }
  } else if (far_ahead) {
    intake.count_unreadable(1);
    datagram.samples.clear();
    block.after = after_;
    return block;
  }
  const std::uint64_t behind = datagram.sequence + datagram.samples.size();
  if (datagram.sequence < after_.next) {
    const std::uint64_t known = std::min<std::uint64_t>(after_.next - datagram.sequence, datagram.samples.size());
    intake.count_repeated(known);
    datagram.samples.erase(datagram.samples.begin(), datagram.samples.begin() + static_cast<std::ptrdiff_t>(known));
  } else {
    block.lost_before = datagram.sequence - after_.next;
  }
  after_.next = std::max(after_.next, behind);
  block.samples = std::move(datagram.samples);
  block.after = after_;
  return block;
}

UdpReceiver::UdpReceiver(const Address& address, std::vector<std::string> allowed, const std::vector<UdpValve>& valves)
    : socket_(bind_socket(address, Transport::udp)), allowed_(std::move(allowed)) {
  for (const UdpValve& valve : valves) {
    senders_.emplace(valve.id, Sender{valve.intake, DatagramOrder(valve.after), RivalSenders(valve.stalled_after_s)});
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

UdpCounters UdpReceiver::counters() const {
  return {datagrams_, unreadable_, unknown_valve_, not_allowed_, refused_};
}

void UdpReceiver::receive(std::span<const std::uint8_t> bytes, const sockaddr_storage& peer) {
  auto read = read_datagram(bytes);
  Datagram* const datagram = std::get_if<Datagram>(&read);
  if (datagram == nullptr) {
    ++unreadable_;
    return;
  }
  const auto sender = senders_.find(datagram->valve);
  if (sender == senders_.end()) {
    ++unknown_valve_;
    unknown_.note(datagram->valve, peer_host(peer));
    return;
  }
  if (sender->second.rivals.refuses({datagram->session, peer, steady_ns()}, *sender->second.intake)) {
    ++refused_;
    return;
  }
  SampleBlock block = sender->second.order.next(std::move(*datagram), *sender->second.intake);
  if (!block.samples.empty()) sender->second.intake->push(std::move(block));
}

void UdpReceiver::run(const std::stop_token& stop) {
  // Ahead of the threads that work: they have queues, and what the socket cannot hold is lost. Where the system does
  // not allow it, the socket's buffer must do.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), receiver_niceness);
  Datagrams received;
  while (!stop.stop_requested()) {
    const std::size_t count = received.take(socket_.descriptor.number());
    if (count == 0) {
      pollfd waiting{socket_.descriptor.number(), POLLIN, 0};
      (void)::poll(&waiting, 1, idle_ms);
      continue;
    }
    datagrams_ += count;
    for (std::size_t k = 0; k < count; ++k) {
      if (may_send(allowed_, received.peer(k))) {
        receive(received.bytes(k), received.peer(k));
      } else {
        ++not_allowed_;
      }
    }
    // What comes meanwhile is taken together: thousands of valves would else wake the thread for each of their
    // datagrams.
    if (count < datagrams_together) std::this_thread::sleep_for(pause);
  }
}

}  // namespace spoolflow::live
