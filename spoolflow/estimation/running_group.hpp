#pragma once
/// Running sensors of several valves stepped together in SIMD registers of double. Each answers, and remembers, to the
/// last bit what it does by itself: it makes no difference whether, with whom, on which processor or for how long
/// sensors are stepped together.
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "spoolflow/estimation/batch/group_steps.hpp"
#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::estimation {

/// In what valves are stepped together.
enum class GroupRegisters {
  one_valve,  ///< not at all: one after the other
  avx2,       ///< eight valves in two registers
  avx512,     ///< eight valves in one
};
[[nodiscard]] std::string_view name(GroupRegisters registers);
/// Those that this program has and this processor runs; the fastest is the last.
[[nodiscard]] std::vector<GroupRegisters> group_registers();

/// A sensor's next samples, any number of them, and room for as many answers.
struct GroupedRun {
  RunningSensor* sensor;
  std::span<const TimedSample> samples;
  std::span<sensor::Estimate<double>> answers;
};

/// Memory for stepping sensors together, to be used again and again by one thread.
class RunningGroup {
 public:
  /// Throws std::invalid_argument where `registers` are not among group_registers().
  explicit RunningGroup(GroupRegisters registers = group_registers().back());

  /// All samples of all runs; no sensor stands in two of them. Observers of one direction and of whole valves without
  /// port pressures are stepped together where there are enough of them; all others by themselves. Throws
  /// std::invalid_argument where there is other room for answers than samples.
  void step(std::span<const GroupedRun> runs);

 private:
  /// The valves of one kind that are stepped at once, and the numbers of their states.
  struct Kind {
    const batch::GroupSteps* steps = nullptr;  ///< null: none
    std::span<const batch::NumberRun> state_runs{};
    struct Free {
      std::size_t alignment;
      void operator()(void* memory) const;
    };
    std::unique_ptr<void, Free> lanes{nullptr, {1}};
    std::vector<const GroupedRun*> runs{};  ///< that are to be stepped
  };
  void step(Kind& kind);
  void step_together(Kind& kind, std::span<const GroupedRun* const> runs);
  void step_rows(Kind& kind, std::span<const GroupedRun* const> runs, std::size_t from, std::size_t count);
  void put_sample(const Kind& kind, std::size_t row, std::size_t lane, const GroupedRun& run, TimedSample sample);

  Kind observers_, whole_valves_;
  std::vector<double> samples_, answers_;     ///< row after row, in each the numbers, of each the valves side by side
  std::vector<SteppedSample<double>> given_;  ///< row after row, in each the valves
};

}  // namespace spoolflow::estimation
