#pragma once
/// The most stack that a function can take with all that it calls, from what the compiler says of each function's
/// frame.
#include <cstdint>
#include <string>

namespace spoolflow::cortex_m {

/// `call_graph`: GCC's -fcallgraph-info=su of one source (VCG text). `function`: part of its name there, which one
/// function alone has. Functions of libraries count as none. Throws std::runtime_error where it is not found, calls
/// itself, or takes stack that depends on data.
[[nodiscard]] std::uint32_t worst_stack_bytes(const std::string& call_graph, const std::string& function);

}  // namespace spoolflow::cortex_m
