#pragma once
/// What an instruction set offers to a ValveBatch. Plain functions over plain memory, as in packs/group_steps.hpp.
#include <array>
#include <cstddef>

#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::estimation::batch {

/// A number of sensor::Estimate, counted in their order, and where to write it.
struct WantedAnswer {
  std::size_t number;
  void* to;  ///< 32 bits a valve: of the first valve
};

/// Where a row's numbers of the first valve lie.
struct BatchRows {
  std::array<const float*, 7> samples;  ///< in the order of sensor::Sample (5) or sensor::WholeValveSample
  std::array<WantedAnswer, 9> answers;
  std::size_t wanted;  ///< of the answers
  std::size_t stride;  ///< from sample to sample
  std::size_t count;   ///< of samples
};

struct BatchSteps {
  std::size_t bytes;
  std::size_t alignment;
  std::size_t valves;  ///< at once
  /// `valves`: the parameters of each; of whole valves those of direction b of all, then those of a.
  /// `numbers`: a beginning that all valves' numbers have in common. False where the description of the numbers names
  /// more of them than there is room for.
  bool (*begin)(void* memory, const void* const* valves, const float* numbers);
  void (*step)(void* memory, const BatchRows& rows);
};

// Where the compiler's target has none, bytes = 0.
extern const BatchSteps condensed_baseline, condensed_avx2, condensed_avx512;
extern const BatchSteps observer_baseline, observer_avx2, observer_avx512_eight, observer_avx512;
extern const BatchSteps whole_condensed_baseline, whole_condensed_avx2, whole_condensed_avx512;
extern const BatchSteps whole_valve_baseline, whole_valve_avx2, whole_valve_avx512_eight, whole_valve_avx512;

}  // namespace spoolflow::estimation::batch
