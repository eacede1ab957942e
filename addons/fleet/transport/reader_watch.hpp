#pragma once
/// What to do about a reader of a stream that says nothing. Pure: the times are those that the caller gives.
#include <chrono>

namespace spoolflow::fleet {

/// It may have nothing to say; its server may be gone, and it with it; or it is there and was forgotten by servers that
/// were killed, or stands on one that has yet to catch up, which only another reader finds out. That one costs four
/// requests, so it is made of any that is silent; less often where several in a row had nothing to say.
class ReaderWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class Step : unsigned char {
    wait,
    ask,    ///< whether it is there, and whether it has something that it does not say
    renew,  ///< make another
  };
  /// `silent_before`: readers in a row that had nothing to say before this one.
  explicit ReaderWatch(Time now, int silent_before = 0)
      : heard_(now), asked_(now), renews_after_(silent_before < tried_at_once ? 2 : 4) {}
  void heard(Time now) {
    heard_ = asked_ = now;
    has_spoken_ = true;
  }
  [[nodiscard]] bool has_spoken() const { return has_spoken_; }
  /// It is there and has nothing.
  void answered(Time now) { asked_ = now; }
  [[nodiscard]] Step silent(Time now) const {
    if (now - heard_ >= renews_after_) return Step::renew;
    return now - asked_ >= asks_after ? Step::ask : Step::wait;
  }

 private:
  static constexpr std::chrono::seconds asks_after{1};
  static constexpr int tried_at_once = 5;
  Time heard_, asked_;
  std::chrono::seconds renews_after_;
  bool has_spoken_ = false;
};

}  // namespace spoolflow::fleet
