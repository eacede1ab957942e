#pragma once
/// Whether a fleet that can be reached commits nothing for long, though blocks wait. Pure: the times are those that the
/// caller gives.
#include <chrono>
#include <optional>

namespace spoolflow::fleet {

class Standstill {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class News : unsigned char { none, begins, ends };
  /// Far longer than a worker takes for a commit, a server to come back, or a stream to be made again.
  static constexpr std::chrono::seconds patience{60};

  void committed(Time now) { since_ = now; }
  /// To be called again and again while the fleet can be reached.
  [[nodiscard]] News look(bool blocks_wait, Time now) {
    if (!since_ || !blocks_wait) since_ = now;
    const bool stands = now - *since_ >= patience;
    if (stands == stands_) return News::none;
    stands_ = stands;
    return stands ? News::begins : News::ends;
  }
  /// While it cannot be reached, nothing is to be expected.
  void away() {
    since_.reset();
    stands_ = false;
  }

 private:
  std::optional<Time> since_;
  bool stands_ = false;
};

}  // namespace spoolflow::fleet
