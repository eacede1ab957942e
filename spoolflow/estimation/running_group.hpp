#pragma once
/// Running sensors of several valves stepped together in SIMD registers of double. Each answers, and remembers, to the
/// last bit what it does by itself: it makes no difference whether, with whom, on which processor or for how long
/// sensors are stepped together.
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "spoolflow/estimation/packs/group_steps.hpp"
#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::estimation {

/// In what valves are stepped together.
enum class GroupRegisters {
  one_valve,  ///< not at all: one after the other
  avx2,       ///< four valves
  avx512,     ///< eight, or four where there are no more
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
  using Runs = std::span<const GroupedRun* const>;
  /// Valves side by side in one kind of registers.
  struct Lanes {
    struct Free {
      std::size_t alignment;
      void operator()(void* memory) const;
    };
    const packs::GroupSteps* steps;
    std::size_t least;  ///< valves for which it pays
    std::unique_ptr<void, Free> memory;
  };
  /// Valves of one kind.
  struct Kind {
    std::vector<Lanes> lanes{};                      ///< the widest last
    std::span<const packs::NumberRun> state_runs{};  ///< the numbers of their states
    std::vector<const GroupedRun*> runs{};           ///< that are to be stepped
  };
  void begin(Kind& kind, const packs::GroupSteps& steps);
  void step(Kind& kind);
  void step_some(Kind& kind, Runs runs);
  [[nodiscard]] Runs step_together(const Kind& kind, Lanes& lanes, Runs runs, std::size_t& done);
  void step_rows(const Lanes& lanes, Runs runs, std::size_t from, std::size_t count);
  void put_sample(const packs::GroupSteps& steps, std::size_t row, std::size_t lane, const GroupedRun& run,
                  TimedSample sample);

  Kind observers_, whole_valves_;
  std::vector<double> samples_, answers_;     ///< row after row, in each the numbers, of each the valves side by side
  std::vector<SteppedSample<double>> given_;  ///< row after row, in each the valves
};

}  // namespace spoolflow::estimation
