#pragma once
/// What an instruction set offers to sensors in double precision that are stepped together. Plain functions over plain
/// memory: a translation unit for a newer instruction set must not share code with others, who might run it on a
/// processor that does not know it.
#include <cstddef>
#include <cstdint>
#include <span>

namespace spoolflow::estimation::packs {

/// As which kind a number of a state lies in one valve.
enum class NumberKind : std::uint8_t {
  number,  ///< double
  truth,   ///< bool
  whole,   ///< int
  motion,  ///< sensor::Motion
  word,    ///< sensor::Status
};

/// Numbers of a state that lie in a row.
struct NumberRun {
  NumberKind kind;
  std::size_t offset;  ///< of the first, in bytes
  std::size_t count;
};

/// Several valves of one kind. Numbers of `State` and those of the valves side by side follow each other in the same
/// order.
struct GroupSteps {
  std::size_t bytes;
  std::size_t alignment;
  std::size_t valves;    ///< at once; 0 where the compiler's target has none
  std::size_t channels;  ///< of a sample
  std::size_t numbers;   ///< of a state
  /// `valves`: the parameters of each; of whole valves those of direction b of all, then those of a. They are read for
  /// as long as the memory is used. False where their description names more numbers than there is room for.
  bool (*begin)(void* memory, const void* const* valves);
  /// The state of one valve: `runs` are those of its type.
  void (*load)(void* memory, std::size_t valve, const void* state, std::span<const NumberRun> runs);
  void (*store)(const void* memory, std::size_t valve, void* state, std::span<const NumberRun> runs);
  /// `samples`: sample after sample, in each the channels in the order of sensor::Sample or sensor::WholeValveSample,
  /// in each the valves. `answers`: likewise the numbers of sensor::Estimate, its status as a whole number of 64 bits.
  void (*step)(void* memory, const double* samples, double* answers, std::size_t count);
};

inline constexpr std::size_t numbers_of_an_answer = 9;

extern const GroupSteps observer_group_avx2;
extern const GroupSteps observer_group_avx512;
extern const GroupSteps whole_valve_group_avx2;
extern const GroupSteps whole_valve_group_avx512;

}  // namespace spoolflow::estimation::packs
