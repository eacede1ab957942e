#pragma once
/// What an instruction set offers to a PlantGroup. Plain functions over plain memory: a translation unit for a newer
/// instruction set must not share code with others, who might run it on a processor that does not know it.
#include <cstddef>

#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

struct PlantSteps {
  std::size_t valves = 0;  ///< at once; 0 where the compiler's target has none
  std::size_t bytes = 0, alignment = 1;
  /// `parameters` and `states` of so many valves, in whose order all else goes; the first must outlive the memory.
  /// `numbers`: of the parameters in the order of their description, valves side by side.
  void (*begin)(void* memory, const PlantParameters* const* parameters, const double* numbers,
                const PlantState* const* states) = nullptr;
  void (*step)(void* memory, const PlantInput* const* inputs, double dt_s) = nullptr;
  /// Into each state what drives electronics and instruments: time, position, velocity, the coils' fluxes.
  void (*show)(const void* memory, PlantState* const* states) = nullptr;
  void (*observe)(void* memory, const PlantInput* const* inputs, PlantOutput* const* outputs) = nullptr;
};

extern const PlantSteps plant_avx2;

}  // namespace spoolflow::rig
