#pragma once
/// What happened at a site, newest last, as far as it is kept in memory; the store keeps them longer.
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "addons/live/history/store.hpp"
#include "addons/live/sources/intake.hpp"  // wall_ms

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

}  // namespace spoolflow::live
