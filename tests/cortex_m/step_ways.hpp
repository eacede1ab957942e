#pragma once
/// The step of a firmware's program: its machine code, the longest way through it, and the ways that were taken.
#include <string>

#include "tests/cortex_m/longest_way.hpp"
#include "tests/cortex_m/workshop.hpp"

namespace spoolflow::cortex_m {

/// What main of firmware/replay.cpp takes for the call itself.
inline constexpr std::uint32_t call_instructions = 1;

/// The function `one_step` of a program in the workshop, and all that it calls.
[[nodiscard]] StepCode step_code_of(Workshop& workshop, const std::string& program);

/// Through that function. The program needs lines of source (-g): the loops that are known run over the stops of the
/// hysteresis. Any other throws std::runtime_error with function, address and line.
[[nodiscard]] std::vector<std::uint32_t> longest_way_of(Workshop& workshop, const std::string& program,
                                                        const StepCode& code);

}  // namespace spoolflow::cortex_m
