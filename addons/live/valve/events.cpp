#include "addons/live/valve/events.hpp"

#include <algorithm>
#include <iterator>

namespace spoolflow::live {

void Events::add(Event event) {
  const std::lock_guard lock(mutex_);
  events_.push_back(std::move(event));
  if (events_.size() > most) events_.pop_front();
}

void Events::restore(std::vector<Event> events) {
  const std::lock_guard lock(mutex_);
  events_.assign(std::make_move_iterator(events.begin()), std::make_move_iterator(events.end()));
}

std::vector<Event> Events::all() const {
  const std::lock_guard lock(mutex_);
  return {events_.begin(), events_.end()};
}

std::vector<Event> Events::unkept() const {
  const std::lock_guard lock(mutex_);
  std::vector<Event> out;
  std::copy_if(events_.begin(), events_.end(), std::back_inserter(out),
               [](const Event& event) { return event.id == 0; });
  return out;
}

void Events::kept(const std::vector<Event>& numbered) {
  const std::lock_guard lock(mutex_);
  // Events are only added at the end: the first that have no number are those that were asked for, but for such as
  // left the memory since then.
  auto next = numbered.rbegin();
  const auto same = [](const Event& a, const Event& b) {
    return a.wall_ms == b.wall_ms && a.valve == b.valve && a.kind == b.kind && a.text == b.text;
  };
  for (auto event = events_.rbegin(); event != events_.rend() && next != numbered.rend(); ++event) {
    if (event->id != 0 || !same(*event, *next)) continue;
    event->id = next->id;
    ++next;
  }
}

}  // namespace spoolflow::live
