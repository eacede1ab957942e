#pragma once
/// How far the blocks of one valve have come on their way from a site to the fleet, and which are to be sent now.
/// Pure: the times are those that the caller gives.
#include <chrono>
#include <cstdint>

namespace spoolflow::fleet {

/// While nothing is covered the first block that waits is sent again every two seconds, by itself: so blocks go on as
/// soon as the way is open again, however long it was closed, and a fleet that is away is not flooded meanwhile. Where
/// that block alone comes to be covered, those behind it were lost as well and are sent again at once.
class Delivery {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// The next blocks of the store behind the number `after`, at most so many; none where there is nothing to send.
  struct Due {
    std::uint64_t after = 0, most = 0;
  };

  Delivery() = default;
  /// Of the site's store with that session, of which the fleet has committed all blocks up to `covered`.
  Delivery(std::uint64_t session, std::uint64_t covered) : session_(session), covered_(covered), sent_(covered) {}

  [[nodiscard]] std::uint64_t session() const { return session_; }
  /// Blocks of the store that the fleet has not committed.
  [[nodiscard]] std::uint64_t waiting() const { return newest_ > covered_ ? newest_ - covered_ : 0; }
  /// The newest block that the store has.
  void found(std::uint64_t newest) { newest_ = newest; }
  [[nodiscard]] Due due(Time now);
  /// That block was handed to the servers, which says nothing.
  void sent(std::uint64_t number, Time now);
  /// The fleet says that it has committed all up to that block. False where that is no news, or cannot be.
  bool covered(std::uint64_t number, Time now);
  /// The fleet misses that block.
  void asked(std::uint64_t number);

 private:
  std::uint64_t session_ = 0;
  std::uint64_t covered_ = 0, sent_ = 0, newest_ = 0;
  std::uint64_t alone_ = 0;  ///< the block that was sent again by itself; 0: none
  bool sends_alone_ = false;
  Time moved_{};  ///< when something was covered, or sent again
};

}  // namespace spoolflow::fleet
