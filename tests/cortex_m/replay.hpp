#pragma once
/// Cross-compiles an exported folder, replays a recording through it on an emulated core, and returns what came out.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::cortex_m {

struct Core {
  const char* name;
  const char* flags;    ///< of the compiler
  const char* machine;  ///< of QEMU
  const char* libraries = "-lgcc";
};
/// Its name in the names of tests.
inline void PrintTo(const Core& core, std::ostream* out) {
  *out << core.name;
}
inline constexpr std::array<Core, 2> cores{
    {{"Cortex-M4F", "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard", "mps2-an386"},
     {"Cortex-M7", "-mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard", "mps2-an500"}}};
/// Without a floating-point unit. The code of a Cortex-M0+ runs on the M3, whose instructions are all of its and more.
inline constexpr std::array<Core, 2> soft_float_cores{
    {{"Cortex-M3", "-mcpu=cortex-m3 -mfloat-abi=soft", "mps2-an385", "-lm -lc -lgcc"},
     {"Cortex-M0+", "-mcpu=cortex-m0plus -mfloat-abi=soft", "mps2-an385", "-lm -lc -lgcc"}}};

/// Instructions of one step, call and return included. Emulated: a count, no time.
struct StepCost {
  std::string way;  ///< through the step
  std::uint32_t steps;
  std::uint32_t median;
  std::uint32_t mean;  ///< rounded
  std::uint32_t largest;
};

struct Replay {
  std::uint32_t points;          ///< samples replayed
  double largest_error_percent;  ///< of the rated flow, single precision on the core against double on the host
  std::uint32_t not_a_number;    ///< answers with a NaN in them
  bool made_nan;                 ///< the floating-point unit's flag, while no input was missing
  bool met_denormal;             ///< the floating-point unit's flag
  sensor::Status statuses;       ///< every bit that was ever set
  StepCost all;
  std::vector<StepCost> ways;  ///< each that was taken
  std::uint32_t state_bytes;
  std::optional<std::uint32_t> longest_way;  ///< by the graph of the step's code; with a floating-point unit alone
  std::uint32_t stack_bytes;                 ///< of the first step, measured
  std::uint32_t worst_stack_bytes;           ///< of any step with all that it may call, by the compiler's frames
  std::uint32_t flash_bytes;  ///< code and tables of this sensor, linked without any library but the compiler's
};

/// The command that compiles `replay.elf`, with lines of source in it.
[[nodiscard]] std::string replay_firmware(estimation::Estimator estimator, const Core& core);

/// A valve that has the one direction of `model` on both sides.
[[nodiscard]] model::Model on_both_sides(model::Model model);

/// Throws std::runtime_error with what the tools said where one of them fails.
[[nodiscard]] Replay replay(const model::Model& model, estimation::Estimator estimator,
                            const std::filesystem::path& recording, const Core& core);

/// What the exported self-test, which steps every sensor of the model, ends with on the core. Throws as replay does.
[[nodiscard]] int self_test_status(const model::Model& model, const Core& core);

}  // namespace spoolflow::cortex_m
