#include "addons/live/valve/block_cutter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "addons/live/valve/events.hpp"

namespace spoolflow::live {

BlockCutter::BlockCutter(std::string name, std::string model_sha256, OutboxPosition after, const BlockLimits& limits)
    : name_(std::move(name)), model_sha256_(std::move(model_sha256)), position_(std::move(after)), limits_(limits) {}

void BlockCutter::add(const estimation::TimedSample& sample) {
  // Also where time runs back: the times of a block lie close together.
  const bool apart = !samples_.empty() && !(std::abs(sample.time_s - samples_.front().time_s) < limits_.longest_s) &&
                     std::isfinite(sample.time_s);
  if (apart || samples_.size() >= fleet::most_samples) close();
  samples_.push_back(sample);
}

void BlockCutter::close() {
  if (samples_.empty()) return;
  fleet::Block block{.valve = name_, .model_sha256 = model_sha256_, .session = position_.session};
  block.number = block.first = ++position_.number;
  block.wall_ms = wall_ms();
  block.samples = std::exchange(samples_, {});
  closed_.push_back({block.number, fleet::write_block(block)});
}

std::vector<OutboxBlock> BlockCutter::take() {
  close();
  return std::exchange(closed_, {});
}

std::size_t BlockCutter::give_back(std::vector<OutboxBlock> blocks) {
  closed_.insert(closed_.begin(), std::make_move_iterator(blocks.begin()), std::make_move_iterator(blocks.end()));
  std::size_t bytes = 0;
  auto first = closed_.end();
  while (first != closed_.begin() && bytes + std::prev(first)->bytes.size() <= limits_.waiting_bytes) {
    bytes += (--first)->bytes.size();
  }
  const auto given_up = static_cast<std::size_t>(first - closed_.begin());
  closed_.erase(closed_.begin(), first);
  return given_up;
}

}  // namespace spoolflow::live
