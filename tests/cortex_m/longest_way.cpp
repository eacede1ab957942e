#include "tests/cortex_m/longest_way.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace spoolflow::cortex_m {
namespace {

using Addresses = std::vector<std::uint32_t>;
using Nodes = std::set<std::uint32_t>;

/// The ways through one function, whose loops are taken apart one after the other: what the rounds of a loop take at
/// the most is put before its first instruction, and the edges that lead back there are cut.
class Function {
 public:
  Function(const MachineFunction& function, std::uint32_t entry, const LoopBounds& bounds,
           const std::map<std::uint32_t, Addresses>& calls)
      : function_(function), entry_(entry), bounds_(bounds) {
    for (const auto& [address, instruction] : function.code) {
      Addresses& takes = takes_[address] = {address};
      for (const std::uint32_t next : instruction.next) edges_[address].insert(next);
      if (!instruction.calls) continue;
      const Addresses& called = calls.at(*instruction.calls);
      takes.insert(takes.end(), called.begin(), called.end());
    }
  }

  Addresses longest() {
    Nodes all, ends;
    for (const auto& [address, instruction] : function_.code) {
      all.insert(address);
      if (instruction.returns || instruction.next.empty()) ends.insert(address);
    }
    cut_loops(all, entry_);
    return longest_to(ends, entry_, all);
  }

 private:
  [[noreturn]] void refuse(std::uint32_t address, const char* why) const {
    throw std::runtime_error(fmt::format("{}: {:#x}: {}", function_.name, address, why));
  }

  /// Nodes of `within` that lie behind one that comes before: a depth-first walk, latest ended first.
  Addresses order(const Nodes& within, std::uint32_t entry) const {
    Addresses out, ahead{entry};
    std::map<std::uint32_t, int> seen;
    while (!ahead.empty()) {
      const std::uint32_t node = ahead.back();
      int& state = seen[node];
      if (state++ > 0) {
        if (state == 2) out.push_back(node);
        ahead.pop_back();
        continue;
      }
      for (const std::uint32_t next : next_of(node))
        if (within.count(next) > 0 && seen.count(next) == 0) ahead.push_back(next);
    }
    std::reverse(out.begin(), out.end());
    return out;
  }

  const Nodes& next_of(std::uint32_t node) const {
    static const Nodes none;
    const auto found = edges_.find(node);
    return found == edges_.end() ? none : found->second;
  }

  /// Nodes from which `node` is reached and which it reaches, itself apart where it is none of a loop.
  std::vector<Nodes> loops_in(const Nodes& within, std::uint32_t entry) const {
    std::map<std::uint32_t, Addresses> before;
    for (const std::uint32_t node : within)
      for (const std::uint32_t next : next_of(node))
        if (within.count(next) > 0) before[next].push_back(node);
    std::vector<Nodes> out;
    Nodes done;
    for (const std::uint32_t first : order(within, entry)) {  // Kosaraju: backwards, in the order of the walk
      Nodes strong;
      Addresses ahead{first};
      while (!ahead.empty()) {
        const std::uint32_t node = ahead.back();
        ahead.pop_back();
        if (!done.insert(node).second) continue;
        strong.insert(node);
        ahead.insert(ahead.end(), before[node].begin(), before[node].end());
      }
      if (strong.size() > 1 || next_of(first).count(first) > 0) out.push_back(strong);
    }
    return out;
  }

  void cut_loops(const Nodes& within, std::uint32_t entry) {
    for (const Nodes& loop : loops_in(within, entry)) {
      Nodes entered;
      if (loop.count(entry) > 0) entered.insert(entry);
      for (const std::uint32_t node : within)
        for (const std::uint32_t next : next_of(node))
          if (loop.count(node) == 0 && loop.count(next) > 0) entered.insert(next);
      if (entered.size() != 1) refuse(*loop.begin(), "a loop that is entered at two places");
      cut_loop(loop, *entered.begin());
    }
  }

  void cut_loop(const Nodes& loop, std::uint32_t first) {
    Nodes back;
    for (const std::uint32_t node : loop)
      if (edges_[node].erase(first) > 0) back.insert(node);
    cut_loops(loop, first);
    const auto rounds = bounds_(first);
    if (!rounds) throw UnknownLoop(function_.name, first);
    const Addresses round = longest_to(back, first, loop);
    Addresses& takes = takes_[first];
    Addresses all;
    for (std::uint32_t k = 0; k < *rounds; ++k) all.insert(all.end(), round.begin(), round.end());
    takes.insert(takes.begin(), all.begin(), all.end());
  }

  /// There is no loop in `within` any more.
  Addresses longest_to(const Nodes& ends, std::uint32_t entry, const Nodes& within) const {
    std::map<std::uint32_t, std::pair<std::size_t, std::uint32_t>> reached;  // instructions up to here, the one before
    reached[entry] = {takes_.at(entry).size(), entry};
    std::uint32_t last = entry;
    std::size_t most = 0;
    for (const std::uint32_t node : order(within, entry)) {
      const std::size_t length = reached.at(node).first;
      if (ends.count(node) > 0 && length > most) most = length, last = node;
      for (const std::uint32_t next : next_of(node)) {
        if (within.count(next) == 0) continue;
        auto& there = reached[next];
        const std::size_t longer = length + takes_.at(next).size();
        if (longer > there.first) there = {longer, node};
      }
    }
    if (most == 0) refuse(entry, "never comes back");
    Addresses nodes{last}, out;
    while (nodes.back() != entry) nodes.push_back(reached.at(nodes.back()).second);
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
      out.insert(out.end(), takes_.at(*node).begin(), takes_.at(*node).end());
    return out;
  }

  const MachineFunction& function_;
  std::uint32_t entry_;
  const LoopBounds& bounds_;
  std::map<std::uint32_t, Nodes> edges_;
  std::map<std::uint32_t, Addresses> takes_;  ///< what an instruction takes with all that it calls
};

void solve(const StepCode& code, std::uint32_t entry, const LoopBounds& bounds,
           std::map<std::uint32_t, Addresses>& ways, Nodes& open) {
  const MachineFunction& function = code.functions.at(entry);
  if (!open.insert(entry).second) throw std::runtime_error(function.name + ": calls itself");
  for (const auto& [address, instruction] : function.code)
    if (instruction.calls && ways.count(*instruction.calls) == 0) solve(code, *instruction.calls, bounds, ways, open);
  ways[entry] = Function(function, entry, bounds, ways).longest();
  open.erase(entry);
}

}  // namespace

UnknownLoop::UnknownLoop(const std::string& function, std::uint32_t where)
    : std::runtime_error(fmt::format("{}: {:#x}: a loop whose bound is not known", function, where)), address(where) {}

std::vector<std::uint32_t> longest_way(const StepCode& code, const LoopBounds& bounds) {
  std::map<std::uint32_t, Addresses> ways;
  Nodes open;
  solve(code, code.entry, bounds, ways, open);
  return ways.at(code.entry);
}

}  // namespace spoolflow::cortex_m
