#pragma once
/// What to do about a reader of a stream that says nothing. Pure: the times are those that the caller tells.
#include <chrono>

namespace spoolflow::fleet {

/// It may have nothing to say; its server may be gone, and it with it; or it is there and was forgotten by servers that
/// were killed, which only another reader finds out. That one costs three requests, so it is made of any that is
/// silent.
class ReaderWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class Step : unsigned char {
    wait,
    ask,    ///< whether it is there, and whether it has something that it does not say
    renew,  ///< make another
  };
  /// After so long a silence.
  static constexpr std::chrono::milliseconds asks_after{1500}, renews_after{3000};

  explicit ReaderWatch(Time now) : heard_(now), asked_(now) {}
  void heard(Time now) { heard_ = asked_ = now; }
  /// It is there and has nothing.
  void answered(Time now) { asked_ = now; }
  [[nodiscard]] Step silent(Time now) const {
    if (now - heard_ >= renews_after) return Step::renew;
    return now - asked_ >= asks_after ? Step::ask : Step::wait;
  }

 private:
  Time heard_, asked_;
};

}  // namespace spoolflow::fleet
