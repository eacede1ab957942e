#pragma once
/// The plants of several valves stepped at once in SIMD registers, each exactly as alone, to the last bit. Where the
/// processor has no AVX2, one after the other.
///
///     PlantGroup group(parameters, states);          // plants that are alike, each at its own state
///     group.step(inputs, 1e-4);                      // one period of all; inputs held over it
///     group.observe(inputs, truths);                 // ground truth of all
#include <span>
#include <vector>

#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

struct PlantSteps;

/// Valves that one set of the processor's registers holds: 4 with AVX2, else 1.
[[nodiscard]] std::size_t plants_at_once();

/// Whether both have the same arrangement, kind of load and kinds of hysteresis, so that they may be stepped at once.
[[nodiscard]] bool alike(const PlantParameters& one, const PlantParameters& other);

class PlantGroup {
 public:
  /// The parameters must outlive the group and be alike. As many valves as one likes; a last one that is left over is
  /// stepped alone.
  PlantGroup(std::span<const PlantParameters* const> parameters, std::span<const PlantState> states);
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
  [[nodiscard]] Memory memory_of(std::size_t first, std::size_t left) const;
  std::vector<const PlantParameters*> parameters_;
  std::vector<PlantState> states_;
  std::vector<Memory> together_;
};

}  // namespace spoolflow::rig
