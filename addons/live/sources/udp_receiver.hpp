#pragma once
/// One UDP socket for all valves of a site that send datagrams; each finds its intake by the valve's id.
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "addons/live/sources/datagram.hpp"
#include "addons/live/sources/intake.hpp"
#include "addons/live/sources/socket.hpp"

namespace spoolflow::live {

/// Puts the datagrams of one valve in order by their sequence numbers: tells what was lost, leaves out what came
/// before.
class DatagramOrder {
 public:
  explicit DatagramOrder(SourcePosition after = {}) : after_(after), known_(after.session != 0 || after.next != 0) {}
  /// Samples that are new, possibly none; counts repeated ones and sessions at the intake.
  [[nodiscard]] SampleBlock next(Datagram&& datagram, Intake& intake);

 private:
  SourcePosition after_;
  bool known_;  ///< a session has begun
};

/// A valve whose samples come by UDP.
struct UdpValve {
  std::string id;
  Intake* intake;
  SourcePosition after;  ///< where it goes on
};

/// What came to the socket and belongs to no valve.
struct UdpCounters {
  std::uint64_t datagrams = 0;
  std::uint64_t unreadable = 0;
  std::uint64_t unknown_valve = 0;
  std::uint64_t not_allowed = 0;  ///< from an address that may not send
};

class UdpReceiver {
 public:
  /// `allowed`: addresses that may send; empty: any (loopback only, which the site's settings see to). Throws
  /// SiteError.
  UdpReceiver(const Address& address, std::vector<std::string> allowed, const std::vector<UdpValve>& valves);
  [[nodiscard]] std::uint16_t port() const { return socket_.port; }
  [[nodiscard]] UdpCounters counters() const;

 private:
  struct Sender {
    Intake* intake;
    DatagramOrder order;
  };
  void run(const std::stop_token& stop);
  void receive(std::span<const std::uint8_t> bytes);

  BoundSocket socket_;
  std::vector<std::string> allowed_;
  std::map<std::string, Sender, std::less<>> senders_;
  std::atomic<std::uint64_t> datagrams_ = 0, unreadable_ = 0, unknown_valve_ = 0, not_allowed_ = 0;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace spoolflow::live
