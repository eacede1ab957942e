#pragma once
/// The longest way through machine code, by its graph alone: which branches exclude each other is not asked, so that no
/// input makes it take more instructions.
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/cortex_m/machine_code.hpp"

namespace spoolflow::cortex_m {

/// How often the loop that begins at an address goes back there at the most.
using LoopBounds = std::function<std::optional<std::uint32_t>(std::uint32_t address)>;

struct UnknownLoop : std::runtime_error {
  UnknownLoop(const std::string& function, std::uint32_t address);
  std::uint32_t address;
};

/// The addresses of its instructions as they are executed, loops and calls written out. Throws UnknownLoop where a loop
/// has no bound, std::runtime_error where one is entered at two places or a function calls itself.
[[nodiscard]] std::vector<std::uint32_t> longest_way(const StepCode& code, const LoopBounds& bounds);

}  // namespace spoolflow::cortex_m
