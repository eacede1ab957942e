#pragma once
/// The graph of a function's machine code and of all that it calls, read from what `arm-none-eabi-objdump -d -z` prints
/// of a program in Thumb-2.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace spoolflow::cortex_m {

/// Where an instruction goes on, in its own function.
struct Instruction {
  std::string mnemonic;   ///< without condition and width: "b" of "beq.n", "mov" of "movne"
  std::string condition;  ///< "eq"; empty where it is always executed
  std::string operands;
  std::vector<std::uint32_t> next{};     ///< addresses; none where it always returns
  std::optional<std::uint32_t> calls{};  ///< a function, before it goes on
  bool returns = false;                  ///< or may do so; after a tail call it has called another function before
  bool branches = false;                 ///< a jump, call or return, whatever its condition
};

struct MachineFunction {
  std::string name;                           ///< mangled
  std::map<std::uint32_t, Instruction> code;  ///< what can be reached, by address
};

/// By the functions' first addresses.
using MachineCode = std::map<std::uint32_t, MachineFunction>;

struct StepCode {
  std::uint32_t entry;
  MachineCode functions;
};

/// The function whose mangled name holds `name`, which must be one alone, and all that can be reached from it. Throws
/// std::runtime_error with function and address where the code alone does not show where control goes: an indirect
/// call, an indirect jump that is neither a return nor a table behind TBB or TBH whose index is compared before.
[[nodiscard]] StepCode step_code(const std::string& disassembly, const std::string& name);

}  // namespace spoolflow::cortex_m
