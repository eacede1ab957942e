#pragma once
/// What happened at a site, newest last, as far as it is kept in memory; the store keeps them longer.
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "addons/live/history/store.hpp"

namespace spoolflow::live {

class Events {
 public:
  static constexpr std::size_t most = 1000;

  void add(Event event);
  void restore(std::vector<Event> events);
  [[nodiscard]] std::vector<Event> all() const;
  /// Those that the store has not got yet.
  [[nodiscard]] std::vector<Event> unkept() const;
  /// Their numbers from the store, in the order of unkept().
  void kept(const std::vector<Event>& numbered);

 private:
  mutable std::mutex mutex_;
  std::deque<Event> events_;
};

/// Milliseconds since 1970-01-01 UTC.
[[nodiscard]] std::int64_t wall_ms();

}  // namespace spoolflow::live
