#pragma once
/// Steps that an emulator has run, held against the graph of their code.
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "tests/cortex_m/machine_code.hpp"

namespace spoolflow::cortex_m {

/// Follows the emulator's log (`-d exec,nochain`) from block to block: a block is executed from where it begins to its
/// first branch, and the next begins where that branch may lead.
class FollowedSteps {
 public:
  explicit FollowedSteps(const StepCode& code);

  /// A line of the log. Throws std::runtime_error where control went along no edge of the graph.
  void read(const std::string& line);
  /// After the last line.
  void end();

  [[nodiscard]] std::uint32_t steps() const { return steps_; }
  /// Addresses of the instructions of the step that had most of them, as they were executed.
  [[nodiscard]] const std::vector<std::uint32_t>& largest() const { return largest_; }
  /// Ranges of addresses whose blocks are to be in the log, as `-dfilter` takes them.
  [[nodiscard]] std::string filter() const;

 private:
  void begin_block(std::uint32_t address);
  bool leads_to(const Instruction& branch, std::uint32_t address);
  void begin_step(std::uint32_t address);
  void end_step();

  const StepCode& code_;
  std::unordered_map<std::uint32_t, const Instruction*> instructions_;
  std::vector<std::uint32_t> path_, largest_, returns_to_;
  std::uint32_t block_ = 0, pending_ = 0, steps_ = 0;
  bool has_pending_ = false, in_step_ = false;
};

}  // namespace spoolflow::cortex_m
