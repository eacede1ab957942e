#include "tests/cortex_m/machine_code.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace spoolflow::cortex_m {
namespace {

/// An instruction as it is printed, before anybody asks where it leads.
struct Line {
  std::string mnemonic, operands;
  std::uint32_t bytes;
  bool in_it_block;
};

struct Listing {
  std::map<std::uint32_t, Line> code;
  std::map<std::uint32_t, std::uint8_t> data;      ///< literals and tables between instructions
  std::map<std::uint32_t, std::string> functions;  ///< by first address
};

[[noreturn]] void refuse(const MachineFunction& function, std::uint32_t address, const Line& line, const char* why) {
  throw std::runtime_error(
      fmt::format("{}: {:#x}: {} {}: {}", function.name, address, line.mnemonic, line.operands, why));
}

std::uint32_t hexadecimal(const std::string& text) {
  return static_cast<std::uint32_t>(std::stoul(text, nullptr, 16));
}

/// "ite" lets two instructions follow.
std::size_t length_of_it_block(const std::string& mnemonic) {
  static const std::regex it("it[te]{0,3}");
  return std::regex_match(mnemonic, it) ? mnemonic.size() - 1 : 0;
}

/// "   1a4:\tf8d0 3000 \tldr.w\tr3, [r0]", and of data ".word\t0x…" with its value in place of halfwords.
Listing listing_of(const std::string& disassembly) {
  static const std::regex heading("([0-9a-f]+) <(.+)>:"), row(" *([0-9a-f]+):\t([0-9a-f ]+)\t(\\S+)\t?([^;@]*).*");
  Listing listing;
  std::istringstream lines(disassembly);
  std::size_t left_of_it_block = 0;
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, heading)) listing.functions[hexadecimal(found[1])] = found[2];
    if (!std::regex_match(line, found, row)) continue;
    const std::uint32_t address = hexadecimal(found[1]);
    std::string bytes = found[2], mnemonic = found[3], operands = found[4];
    bytes.erase(std::remove(bytes.begin(), bytes.end(), ' '), bytes.end());
    operands.erase(operands.find_last_not_of(" \t") + 1);
    const auto size = static_cast<std::uint32_t>(bytes.size() / 2);
    if (mnemonic[0] == '.') {
      for (std::uint32_t k = 0; k < size; ++k)
        listing.data[address + k] = static_cast<std::uint8_t>(hexadecimal(bytes.substr(2 * (size - 1 - k), 2)));
      continue;
    }
    listing.code[address] = {mnemonic, operands, size, left_of_it_block > 0};
    if (left_of_it_block > 0)
      --left_of_it_block;
    else
      left_of_it_block = length_of_it_block(mnemonic);
  }
  return listing;
}

/// "beq.n" is "b" under a condition of its own, "popeq" in an IT block "pop".
std::string without_condition(const Line& line) {
  static const std::regex conditional("(b|bl)(eq|ne|cs|cc|hs|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)");
  const std::string bare = line.mnemonic.substr(0, line.mnemonic.find('.'));
  std::smatch found;
  if (std::regex_match(bare, found, conditional)) return found[1];
  return line.in_it_block && bare.size() > 2 ? bare.substr(0, bare.size() - 2) : bare;
}

/// "r3, 1a4 <name+0x10>" leads to 0x1a4.
std::uint32_t target_of(const std::string& operands) {
  const auto name = operands.find(" <");
  const auto before = operands.rfind(' ', name == std::string::npos ? name : name - 1);
  return hexadecimal(operands.substr(before == std::string::npos ? 0 : before + 1));
}

/// The targets of TBB or TBH at `address`: "cmp r3, #9; bhi …; tbb [pc, r3]" has ten.
std::vector<std::uint32_t> table_targets(const Listing& listing, const MachineFunction& function,
                                         std::uint32_t address) {
  const Line& jump = listing.code.at(address);
  static const std::regex index("\\[pc, ([a-z0-9]+)(, lsl #1)?\\]");
  std::smatch found;
  if (!std::regex_match(jump.operands, found, index)) refuse(function, address, jump, "a table of unknown form");
  const std::string compared = found[1].str() + ", #";
  auto before = listing.code.find(address);
  bool guarded = false;
  for (int k = 0; k < 4 && before != listing.code.begin(); ++k) {
    --before;
    const Line& line = before->second;
    guarded = guarded || line.mnemonic.rfind("bhi", 0) == 0;
    if (guarded && line.mnemonic.rfind("cmp", 0) == 0 && line.operands.rfind(compared, 0) == 0) {
      const auto entries = static_cast<std::uint32_t>(std::stoul(line.operands.substr(compared.size()))) + 1U;
      const std::uint32_t width = jump.mnemonic == "tbh" ? 2 : 1;
      std::vector<std::uint32_t> targets;
      for (std::uint32_t k_entry = 0; k_entry < entries; ++k_entry) {
        std::uint32_t halfwords = 0;
        for (std::uint32_t k_byte = 0; k_byte < width; ++k_byte)
          halfwords |= std::uint32_t{listing.data.at(address + 4U + k_entry * width + k_byte)} << 8U * k_byte;
        targets.push_back(address + 4U + 2U * halfwords);
      }
      return targets;
    }
    if (line.operands.rfind(found[1].str() + ",", 0) == 0) break;
  }
  refuse(function, address, jump, "a jump by a table whose index is not compared right before it");
}

/// A place to which a jump is a call that does not come back: the beginning of another function. What a compiler
/// puts apart as cold has a name of its own and belongs to the function that jumps there.
bool begins_another(const Listing& listing, std::uint32_t address, std::uint32_t own) {
  const auto found = listing.functions.find(address);
  return address != own && found != listing.functions.end() && found->second.find(".cold") == std::string::npos;
}

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

Instruction decoded(const Listing& listing, const MachineFunction& function, std::uint32_t own, std::uint32_t address) {
  const Line& line = listing.code.at(address);
  const std::string what = without_condition(line), bare = line.mnemonic.substr(0, line.mnemonic.find('.'));
  Instruction out{what, bare.substr(what.size()), line.operands};
  out.branches = true;
  const bool conditional = !out.condition.empty() || what == "cbz" || what == "cbnz";
  const bool from_stack = (what == "pop" || (what.rfind("ldm", 0) == 0 && line.operands.rfind("sp!, ", 0) == 0)) &&
                          ends_with(line.operands, "pc}");
  bool goes_on = true;
  if (what == "b" || what == "cbz" || what == "cbnz") {
    const std::uint32_t target = target_of(line.operands);
    if (begins_another(listing, target, own)) {
      if (conditional) refuse(function, address, line, "a tail call under a condition");
      out.calls = target;
      out.returns = true;
    } else {
      out.next.push_back(target);
    }
    goes_on = conditional;
  } else if (what == "bl") {
    out.calls = target_of(line.operands);
  } else if (from_stack || (what == "bx" && line.operands == "lr") ||
             (what == "ldr" && line.operands.rfind("pc, [sp], #", 0) == 0)) {
    out.returns = true;
    goes_on = conditional;
  } else if (what == "tbb" || what == "tbh") {
    if (conditional) refuse(function, address, line, "a jump by a table in an IT block");
    out.next = table_targets(listing, function, address);
    goes_on = false;
  } else if (what == "bx" || what == "blx" || line.operands.rfind("pc,", 0) == 0 || ends_with(line.operands, "pc}")) {
    refuse(function, address, line, "where it leads is not in the code");
  } else {
    out.branches = false;
  }
  if (goes_on) out.next.push_back(address + line.bytes);
  return out;
}

MachineFunction function_at(const Listing& listing, std::uint32_t begin) {
  MachineFunction function{listing.functions.at(begin), {}};
  std::vector<std::uint32_t> ahead{begin};
  while (!ahead.empty()) {
    const std::uint32_t address = ahead.back();
    ahead.pop_back();
    if (function.code.count(address) > 0) continue;
    if (listing.code.count(address) == 0)
      throw std::runtime_error(fmt::format("{}: {:#x} is no instruction", function.name, address));
    const Instruction& instruction = function.code[address] = decoded(listing, function, begin, address);
    ahead.insert(ahead.end(), instruction.next.begin(), instruction.next.end());
  }
  return function;
}

}  // namespace

StepCode step_code(const std::string& disassembly, const std::string& name) {
  const Listing listing = listing_of(disassembly);
  std::vector<std::uint32_t> ahead;
  for (const auto& [address, function] : listing.functions)
    if (function.find(name) != std::string::npos && function.find(".cold") == std::string::npos)
      ahead.push_back(address);
  if (ahead.size() != 1) throw std::runtime_error(fmt::format("{} functions are named {}", ahead.size(), name));
  StepCode out{ahead.front(), {}};
  while (!ahead.empty()) {
    const std::uint32_t begin = ahead.back();
    ahead.pop_back();
    if (out.functions.count(begin) > 0) continue;
    if (listing.functions.count(begin) == 0) throw std::runtime_error(fmt::format("{:#x} begins no function", begin));
    const MachineFunction& function = out.functions[begin] = function_at(listing, begin);
    for (const auto& [address, instruction] : function.code)
      if (instruction.calls) ahead.push_back(*instruction.calls);
  }
  return out;
}

}  // namespace spoolflow::cortex_m
