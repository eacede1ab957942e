#include "spoolflow/live/sources/udp_receiver.hpp"

#include <algorithm>
#include <array>
#include <poll.h>
#include <sys/socket.h>

#include "spoolflow/live/sources/peer.hpp"

namespace spoolflow::live {

SampleBlock DatagramOrder::next(Datagram&& datagram, Intake& intake) {
  SampleBlock block{.arrived_ns = steady_ns()};
  if (!known_ || datagram.session != after_.session) {
    // The first of a session that is met may be in its middle: what was sent before the program ran is not lost by it.
    after_ = {datagram.session, datagram.sequence};
    known_ = true;
    intake.count_connection();
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
  for (const UdpValve& valve : valves) senders_.emplace(valve.id, Sender{valve.intake, DatagramOrder(valve.after)});
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

UdpCounters UdpReceiver::counters() const {
  return {datagrams_, unreadable_, unknown_valve_, not_allowed_};
}

void UdpReceiver::receive(std::span<const std::uint8_t> bytes) {
  auto read = read_datagram(bytes);
  Datagram* const datagram = std::get_if<Datagram>(&read);
  if (datagram == nullptr) {
    ++unreadable_;
    return;
  }
  const auto sender = senders_.find(datagram->valve);
  if (sender == senders_.end()) {
    ++unknown_valve_;
    return;
  }
  SampleBlock block = sender->second.order.next(std::move(*datagram), *sender->second.intake);
  if (!block.samples.empty()) sender->second.intake->push(std::move(block));
}

void UdpReceiver::run(const std::stop_token& stop) {
  constexpr int look_up_ms = 100;
  std::vector<std::uint8_t> bytes(largest_datagram);
  while (!stop.stop_requested()) {
    pollfd waiting{socket_.descriptor.number(), POLLIN, 0};
    if (::poll(&waiting, 1, look_up_ms) <= 0) continue;
    for (;;) {
      sockaddr_storage peer{};
      socklen_t length = sizeof peer;
      const ssize_t got = ::recvfrom(socket_.descriptor.number(), bytes.data(), bytes.size(), MSG_DONTWAIT,
                                     reinterpret_cast<sockaddr*>(&peer), &length);
      if (got < 0 || stop.stop_requested()) break;
      ++datagrams_;
      if (!may_send(allowed_, peer)) {
        ++not_allowed_;
        continue;
      }
      receive({bytes.data(), static_cast<std::size_t>(got)});
    }
  }
}

}  // namespace spoolflow::live
