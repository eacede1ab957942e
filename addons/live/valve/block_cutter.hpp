#pragma once
/// Makes blocks for the fleet of the samples that a valve has worked on.
#include <string>
#include <vector>

#include "addons/live/blocks/block.hpp"
#include "addons/live/history/outbox_table.hpp"

namespace spoolflow::live {

struct BlockLimits {
  double longest_s = 1;                    ///< of samples in a block
  std::size_t waiting_bytes = 16U << 20U;  ///< of blocks in memory that the store could not keep
};

class BlockCutter {
 public:
  /// `after`: of the newest block that was kept; its session, and its number before the next.
  BlockCutter(std::string name, std::string model_sha256, OutboxPosition after, const BlockLimits& limits);

  /// The next sample, on its grids.
  void add(const estimation::TimedSample& sample);
  /// Closes the block that was begun; all that were closed since the last time.
  [[nodiscard]] std::vector<OutboxBlock> take();
  /// They could not be kept, and come again with the next; the oldest beyond the limit are given up. Returns how many.
  std::size_t give_back(std::vector<OutboxBlock> blocks);
  [[nodiscard]] const OutboxPosition& position() const { return position_; }

 private:
  void close();

  std::string name_, model_sha256_;
  OutboxPosition position_;  ///< `valve` is the site's own name of it
  BlockLimits limits_;
  std::vector<estimation::TimedSample> samples_;
  std::vector<OutboxBlock> closed_;
};

}  // namespace spoolflow::live
