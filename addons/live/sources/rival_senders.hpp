#pragma once
/// Whether two senders use the id of one valve, and whose datagrams are taken.
#include <array>
#include <cstdint>
#include <optional>
#include <sys/socket.h>

#include "addons/live/sources/intake.hpp"

namespace spoolflow::live {

/// A datagram's session, where it came from and when, by the steady clock.
struct SessionArrival {
  std::uint32_t session;
  sockaddr_storage peer;
  std::int64_t at_ns;
};

/// Of one valve. A new session takes the place of the one that runs, as that of a sender that was started again: the
/// one before is over then. Where it comes back, two senders run: the datagrams of the running session are taken, those
/// of the other are refused until the running one is silent.
class RivalSenders {
 public:
  /// `silent_after_s`: without a datagram.
  explicit RivalSenders(double silent_after_s) : silent_after_ns_(static_cast<std::int64_t>(1e9 * silent_after_s)) {}
  /// Says at the intake when it begins that two senders run, and when it is over.
  [[nodiscard]] bool refuses(const SessionArrival& arrival, Intake& intake);

  /// From so many refused datagrams on two senders run: fewer may come late from a sender that was started again.
  static constexpr int confirming_datagrams = 8;
  /// Without a refused one for so long only one runs.
  static constexpr std::int64_t over_after_ns = 10'000'000'000;

 private:
  void replace_by(std::uint32_t session);
  void end(Intake& intake);

  std::int64_t silent_after_ns_;
  std::optional<SessionArrival> running_{};
  std::array<std::optional<std::uint32_t>, 4> replaced_{};  ///< sessions, the newest first
  int refused_ = 0;
  std::int64_t refused_ns_ = 0;  ///< when the last one came
};

}  // namespace spoolflow::live
