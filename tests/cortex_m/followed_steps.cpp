#include "tests/cortex_m/followed_steps.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace spoolflow::cortex_m {

FollowedSteps::FollowedSteps(const StepCode& code) : code_(code) {
  for (const auto& [entry, function] : code.functions)
    for (const auto& [address, instruction] : function.code) instructions_[address] = &instruction;
}

std::string FollowedSteps::filter() const {
  std::string out;
  for (const auto& [entry, function] : code_.functions) {
    const std::uint32_t first = function.code.begin()->first, last = function.code.rbegin()->first;
    out += fmt::format("{}{:#x}+{:#x}", out.empty() ? "" : ",", first, last - first + 1);
  }
  return out;
}

void FollowedSteps::read(const std::string& line) {
  // "Trace 0: host [table/address/…] name". A block that is stopped before it was executed is reported again.
  if (line.rfind("Stopped", 0) == 0) has_pending_ = false;
  if (line.rfind("Trace", 0) != 0) return;
  if (has_pending_) begin_block(pending_);
  const auto slash = line.find('/', line.find('['));
  if (slash == std::string::npos) throw std::runtime_error("the emulator's log: " + line);
  pending_ = static_cast<std::uint32_t>(std::stoul(line.substr(slash + 1, 8), nullptr, 16));
  has_pending_ = true;
}

void FollowedSteps::end() {
  if (has_pending_) begin_block(pending_);
  has_pending_ = false;
  if (in_step_) begin_block(code_.entry);
  in_step_ = false;
}

void FollowedSteps::begin_step(std::uint32_t address) {
  if (address != code_.entry) throw std::runtime_error(fmt::format("{:#x} is executed outside a step", address));
  in_step_ = true;
  path_.clear();
  returns_to_.clear();
}

void FollowedSteps::end_step() {
  ++steps_;
  if (path_.size() > largest_.size()) largest_ = path_;
  in_step_ = false;
}

bool FollowedSteps::leads_to(const Instruction& branch, std::uint32_t address) {
  if (branch.calls && *branch.calls == address) {
    if (!branch.returns) returns_to_.push_back(branch.next.front());
    return true;
  }
  for (const std::uint32_t next : branch.next)
    if (!branch.calls && next == address) return true;
  if (!branch.returns || branch.calls) return false;
  if (returns_to_.empty()) {
    if (address != code_.entry) return false;
    end_step();
    begin_step(address);
    return true;
  }
  if (returns_to_.back() != address) return false;
  returns_to_.pop_back();
  return true;
}

void FollowedSteps::begin_block(std::uint32_t address) {
  if (in_step_) {
    std::size_t cut = 0;  // where the emulator ended the block before its branch
    for (std::uint32_t at = block_;;) {
      if (at == address && at != block_) cut = path_.size();
      const auto found = instructions_.find(at);
      if (found == instructions_.end()) throw std::runtime_error(fmt::format("{:#x} is not in the graph", at));
      path_.push_back(at);
      const Instruction& instruction = *found->second;
      if (!instruction.branches) {
        at = instruction.next.front();
        continue;
      }
      if (leads_to(instruction, address)) break;
      if (cut == 0)
        throw std::runtime_error(fmt::format("{:#x} leads to {:#x}, which the graph does not", at, address));
      path_.resize(cut);
      break;
    }
  } else {
    begin_step(address);
  }
  block_ = address;
}

}  // namespace spoolflow::cortex_m
