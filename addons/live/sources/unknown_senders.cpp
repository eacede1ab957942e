#include "addons/live/sources/unknown_senders.hpp"

#include <algorithm>

#include "addons/live/sources/intake.hpp"

namespace spoolflow::live {
namespace {

constexpr std::size_t longest_shown = 200;

std::string shown(const std::string& text) {
  std::string out = text.substr(0, longest_shown);
  std::ranges::replace_if(
      out, [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

}  // namespace

void UnknownSenders::note(const std::string& valve, const std::string& sender) {
  const UnknownSender found{shown(valve), shown(sender)};
  const std::int64_t now_ms = wall_ms();
  const std::lock_guard lock(mutex_);
  auto same = std::ranges::find_if(
      seen_, [&](const UnknownSender& one) { return one.valve == found.valve && one.sender == found.sender; });
  if (same == seen_.end()) {
    if (seen_.size() == most) seen_.erase(std::ranges::min_element(seen_, {}, &UnknownSender::last_ms));
    seen_.push_back(found);
    same = std::prev(seen_.end());
    same->first_ms = now_ms;
  }
  same->last_ms = now_ms;
  ++same->pieces;
}

std::vector<UnknownSender> UnknownSenders::all() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

}  // namespace spoolflow::live
