#pragma once
/// Blocks of several valves worked on by one thread: their sensors are stepped together, all else is done valve by
/// valve.
#include <span>
#include <vector>

#include "addons/live/valve/valve_at_work.hpp"
#include "spoolflow/estimation/running_group.hpp"

namespace spoolflow::live {

/// A valve and its next block.
struct ValveTurn {
  ValveAtWork* valve;
  const SampleBlock* block;
};

/// A valve and all blocks that wait for it, in their order.
struct ValveBlocks {
  ValveAtWork* valve;
  std::vector<SampleBlock> blocks;
};

/// Memory for that, to be used again and again by one thread, with valves on which no other thread works.
class WorkTogether {
 public:
  /// So many turns at once bring as much as more would, and none waits long for the others.
  static constexpr std::size_t most_turns = 16;

  explicit WorkTogether(estimation::GroupRegisters registers = estimation::group_registers().back())
      : group_(registers) {}

  /// To the last bit as if each valve worked on its block by itself. No valve has two turns.
  void work(std::span<const ValveTurn> turns);
  /// The same of several blocks of each, the next ones at once.
  void work(std::span<const ValveBlocks> waiting);

 private:
  void work_at_once(std::span<const ValveTurn> turns);

  estimation::RunningGroup group_;
  std::vector<std::vector<estimation::TimedSample>>
      samples_;  ///< of each turn whose valve publishes, in the fleet's grid
  std::vector<std::vector<sensor::Estimate<double>>> answers_;
  std::vector<estimation::GroupedRun> runs_;
  std::vector<ValveTurn> turns_;
};

}  // namespace spoolflow::live
