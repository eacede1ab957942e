#include "addons/fleet/delivery.hpp"

#include <algorithm>

namespace spoolflow::fleet {
namespace {

/// Blocks of one valve on their way at a time.
constexpr std::uint64_t blocks_under_way = 64;
/// What is not covered for so long is sent again; a commit each half second is well within it.
constexpr std::chrono::seconds sent_again_after{2};

}  // namespace

Delivery::Due Delivery::due(Time now) {
  if (sent_ > covered_ && now - moved_ > sent_again_after) {
    moved_ = now;
    sends_alone_ = true;
    return {covered_, 1};
  }
  sends_alone_ = false;
  // Numbers that the store has given up count as well: then nothing more is sent until what stands for them is covered.
  const std::uint64_t under_way = sent_ - covered_;
  if (sent_ >= newest_ || under_way >= blocks_under_way) return {};
  return {sent_, blocks_under_way - under_way};
}

void Delivery::sent(std::uint64_t number, Time now) {
  if (sent_ == covered_) moved_ = now;
  sent_ = std::max(sent_, number);
  if (sends_alone_) alone_ = number;
  sends_alone_ = false;
}

bool Delivery::covered(std::uint64_t number, Time now) {
  if (number <= covered_ || number > newest_) return false;
  covered_ = number;
  sent_ = number == alone_ ? number : std::max(sent_, number);
  if (number >= alone_) alone_ = 0;
  moved_ = now;
  return true;
}

void Delivery::asked(std::uint64_t number) {
  if (number > covered_) sent_ = std::min(sent_, number - 1);
}

}  // namespace spoolflow::fleet
