#include "addons/live/valve/block_cutter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "addons/live/valve/events.hpp"

namespace spoolflow::live {

BlockCutter::BlockCutter(std::string name, std::string model_sha256, OutboxPosition after, double longest_s)
    : name_(std::move(name)),
      model_sha256_(std::move(model_sha256)),
      position_(std::move(after)),
      longest_s_(longest_s) {}

void BlockCutter::add(const estimation::TimedSample& sample) {
  // Also where time runs back: the times of a block lie close together.
  const bool apart = !samples_.empty() && !(std::abs(sample.time_s - samples_.front().time_s) < longest_s_) &&
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

void BlockCutter::give_back(std::vector<OutboxBlock> blocks) {
  closed_.insert(closed_.begin(), std::make_move_iterator(blocks.begin()), std::make_move_iterator(blocks.end()));
}

}  // namespace spoolflow::live
