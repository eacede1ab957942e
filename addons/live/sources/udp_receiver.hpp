#pragma once
/// One UDP socket for all valves of a site that send datagrams; each finds its intake by the valve's id.
#include <map>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "addons/live/sources/datagram.hpp"
#include "addons/live/sources/intake.hpp"
#include "addons/live/sources/rival_senders.hpp"
#include "addons/live/sources/socket.hpp"
#include "addons/live/sources/unknown_senders.hpp"

namespace spoolflow::live {

/// Puts the datagrams of one valve in order by their sequence numbers: says what was lost, leaves out what came before.
/// A sender that begins again within its session (power-up with the session of the day before), or whose numbers leap
/// far ahead, is accepted after `confirming_datagrams` that follow each other with none in the order before between
/// them: one datagram of wrong numbers mutes no valve.
class DatagramOrder {
 public:
  explicit DatagramOrder(SourcePosition after = {}) : after_(after), known_(after.session != 0 || after.next != 0) {}
  /// Samples that are new, possibly none; counts repeated ones and sessions at the intake.
  [[nodiscard]] SampleBlock next(Datagram&& datagram, Intake& intake);

  static constexpr int confirming_datagrams = 8;
  /// More samples than that are not lost at once without confirmation (a minute at 1 kHz) ...
  static constexpr std::uint64_t most_lost_at_once = 1U << 16U;
  /// ... and more than that (49 days at 1 kHz) are not lost at all: the sender began again.
  static constexpr std::uint64_t most_lost = std::uint64_t{1} << 32U;

 private:
  [[nodiscard]] bool confirms_leap(const Datagram& datagram);

  SourcePosition after_;
  bool known_;                   ///< a session has begun
  std::uint64_t leap_next_ = 0;  ///< what follows on the last datagram out of order
  int leap_datagrams_ = 0;       ///< that followed each other since the last one in order
};

/// A valve whose samples come by UDP.
struct UdpValve {
  std::string id;
  Intake* intake;
  SourcePosition after;    ///< where it goes on
  double stalled_after_s;  ///< as RivalSenders has it
};

/// What came to the socket and belongs to no valve.
struct UdpCounters {
  std::uint64_t datagrams = 0;
  std::uint64_t unreadable = 0;
  std::uint64_t unknown_valve = 0;
  std::uint64_t not_allowed = 0;  ///< from an address that may not send
  std::uint64_t refused = 0;      ///< of a second sender that uses a valve's id (rival_senders.hpp)
};

class UdpReceiver {
 public:
  /// `allowed`: addresses that may send; empty: any (loopback only, which the site's settings see to). Throws
  /// SiteError.
  UdpReceiver(const Address& address, std::vector<std::string> allowed, const std::vector<UdpValve>& valves);
  [[nodiscard]] std::uint16_t port() const { return socket_.port; }
  [[nodiscard]] UdpCounters counters() const;
  [[nodiscard]] std::vector<UnknownSender> unknown_senders() const { return unknown_.all(); }

 private:
  struct Sender {
    Intake* intake;
    DatagramOrder order;
    RivalSenders rivals;
  };
  void run(const std::stop_token& stop);
  void receive(std::span<const std::uint8_t> bytes, const sockaddr_storage& peer);

  BoundSocket socket_;
  std::vector<std::string> allowed_;
  std::map<std::string, Sender, std::less<>> senders_;
  std::atomic<std::uint64_t> datagrams_ = 0, unreadable_ = 0, unknown_valve_ = 0, not_allowed_ = 0, refused_ = 0;
  UnknownSenders unknown_;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace spoolflow::live
