#include "addons/live/sources/rival_senders.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "addons/live/sources/peer.hpp"

namespace spoolflow::live {
namespace {

std::string named(const SessionArrival& sender) {
  return fmt::format("{} (session {})", peer_address(sender.peer).text(), sender.session);
}

}  // namespace

void RivalSenders::replace_by(std::uint32_t session) {
  auto free = std::ranges::find(replaced_, std::optional(session));
  if (free == replaced_.end()) --free;
  std::copy_backward(replaced_.begin(), free, free + 1);
  replaced_.front() = running_->session;
}

void RivalSenders::end(Intake& intake) {
  if (refused_ >= confirming_datagrams) intake.set_trouble({});
  refused_ = 0;
}

bool RivalSenders::refuses(const SessionArrival& arrival, Intake& intake) {
  if (refused_ > 0 && arrival.at_ns - refused_ns_ > over_after_ns) end(intake);
  if (running_ && running_->session != arrival.session) {
    const bool was_replaced = std::ranges::find(replaced_, std::optional(arrival.session)) != replaced_.end();
    if (was_replaced && arrival.at_ns - running_->at_ns <= silent_after_ns_) {
      refused_ns_ = arrival.at_ns;
      if (++refused_ == confirming_datagrams) {
        intake.set_trouble(fmt::format("two senders use this id: samples of {} are taken, those of {} are refused",
                                       named(*running_), named(arrival)));
      }
      return true;
    }
    replace_by(arrival.session);
    end(intake);
  }
  running_ = arrival;
  return false;
}

}  // namespace spoolflow::live
