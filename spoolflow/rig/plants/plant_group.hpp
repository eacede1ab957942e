#pragma once
/// The plants of several valves stepped at once in SIMD registers, each exactly as alone, to the last bit. Where the
/// processor has no such registers, one after the other.
///
///     PlantGroup group(parameters, states);          // plants that are alike, each at its own state
///     group.step(inputs, 1e-4);                      // one period of all; inputs held over it
///     group.observe(inputs, truths);                 // ground truth of all
#include <memory>
#include <span>
#include <vector>

#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

struct PlantSteps;

/// For what registers a group is made.
enum class PlantRegisters { one_valve, avx2, avx512 };

/// Those that program and processor have, the widest last.
[[nodiscard]] std::vector<PlantRegisters> plant_registers();

/// Valves in one set of registers.
[[nodiscard]] std::size_t valves_at_once(PlantRegisters registers);

/// Whether both have the same arrangement, kind of load and kinds of hysteresis, so that they may be stepped at once.
[[nodiscard]] bool alike(const PlantParameters& one, const PlantParameters& other);

class PlantGroup {
 public:
  /// The parameters must outlive the group and be alike. As many valves as one likes; those left over by the widest
  /// registers go into narrower ones.
  PlantGroup(std::span<const PlantParameters* const> parameters, std::span<const PlantState> states,
             PlantRegisters widest = plant_registers().back());
  PlantGroup(PlantGroup&&) noexcept;
  ~PlantGroup();

  [[nodiscard]] std::size_t valves() const { return states_.size(); }
  /// As step() of each; all inputs have a motion or none has. Throws as it does.
  void step(std::span<const PlantInput> inputs, double dt_s);
  /// After a step: time, position, velocity and the coils' fluxes are the valve's; what else it holds need not be.
  [[nodiscard]] const PlantState& state(std::size_t valve) const { return states_[valve]; }
  /// As observe() of each.
  void observe(std::span<const PlantInput> inputs, std::span<PlantOutput> outputs);

 private:
  struct Memory;
  [[nodiscard]] Memory memory_of(const PlantSteps* steps, std::size_t first, std::size_t left) const;
  std::vector<const PlantParameters*> parameters_;
  std::vector<PlantState> states_;
  std::vector<Memory> together_;
};

}  // namespace spoolflow::rig
