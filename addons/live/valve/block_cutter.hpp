#pragma once
/// Makes blocks for the fleet of the samples that a valve has worked on.
#include <string>
#include <vector>

#include "addons/live/blocks/block.hpp"
#include "addons/live/history/outbox_table.hpp"

namespace spoolflow::live {

class BlockCutter {
 public:
  /// `after`: of the newest block that was kept; its session, and its number before the next. `longest_s`: of a block.
  BlockCutter(std::string name, std::string model_sha256, OutboxPosition after, double longest_s);

  /// The next sample, on its grids.
  void add(const estimation::TimedSample& sample);
  /// Closes the block that was begun; all that were closed since the last time.
  [[nodiscard]] std::vector<OutboxBlock> take();
  /// They could not be kept, and come again with the next.
  void give_back(std::vector<OutboxBlock> blocks);
  [[nodiscard]] const OutboxPosition& position() const { return position_; }

 private:
  void close();

  std::string name_, model_sha256_;
  OutboxPosition position_;  ///< `valve` is the site's own name of it
  double longest_s_;
  std::vector<estimation::TimedSample> samples_;
  std::vector<OutboxBlock> closed_;
};

}  // namespace spoolflow::live
