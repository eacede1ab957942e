#pragma once
/// Sensors of many valves stepped at once on one core, each valve with its own model.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::estimation::batch {

/// What the registers of a processor can do.
enum class InstructionSet {
  baseline,  ///< what the whole program is built for; SSE2 on x86-64, four valves a register
  avx2,      ///< eight valves a register
  avx512,    ///< sixteen valves a register; eight that are left in one of AVX2
};
[[nodiscard]] std::string_view name(InstructionSet instructions);
/// Those that this program has and this processor runs; the fastest is the last.
[[nodiscard]] std::vector<InstructionSet> instruction_sets();

/// Samples of all valves: sample after sample, in each the valves side by side. NaN: not measured.
struct SampleRows {
  std::span<const float> time_step_s;
  std::span<const float> current_A;
  std::span<const float> voltage_V;
  std::span<const float> position_m;
  std::span<const float> oil_temperature_K;
};

/// The same of whole valves; see sensor::WholeValveSample.
struct WholeSampleRows {
  std::span<const float> time_step_s;
  std::span<const float> current_a_A;
  std::span<const float> current_b_A;
  std::span<const float> voltage_a_V;
  std::span<const float> voltage_b_V;
  std::span<const float> position_m;  ///< > 0 opens P to B
  std::span<const float> oil_temperature_K;
};

/// What a valve of a batch is made of, and what it measures.
template <class Parameters>
struct BatchedKind {
  using Model = Parameters;  ///< of one direction
  using Rows = SampleRows;
};
template <>
struct BatchedKind<sensor::WholeCondensedTables<float>> {
  using Model = sensor::CondensedTables<float>;
  using Rows = WholeSampleRows;
};
template <>
struct BatchedKind<sensor::WholeValveParameters<float>> {
  using Model = sensor::ObserverParameters<float>;
  using Rows = WholeSampleRows;
};

/// Room for the answers, in the same order. What is not wanted is left empty.
struct EstimateRows {
  std::span<float> flow_m3_per_s;
  std::span<float> flow_lower_m3_per_s;  ///< 95 % band
  std::span<float> flow_upper_m3_per_s;
  std::span<float> pressure_difference_Pa;
  std::span<float> magnetic_force_N;
  std::span<float> spring_force_N;
  std::span<float> flow_force_N;
  std::span<float> friction_force_N;
  std::span<sensor::Status> status;
};

/// As many valves or a multiple of them are stepped together; a batch has a multiple of them.
inline constexpr std::size_t valves_together = 8;

/// The steps of one instruction set, and the memory of the valves that are stepped together.
struct BatchSteps;

/// Sensors of several valves, in single precision: what they answer is what single sensors of float answer.
/// `Parameters` is sensor::CondensedTables<float> or sensor::ObserverParameters<float>, or of valves that open to both
/// sides sensor::WholeCondensedTables<float> or sensor::WholeValveParameters<float>: each stands where it stands,
/// whatever the others do, and its flow is > 0 for P to B.
template <class Parameters>
class ValveBatch {
 public:
  /// Copies the valves; the same one may stand in several places and is kept once. Throws std::invalid_argument
  /// where their number is no multiple of `valves_together`, or `instructions` not among instruction_sets(), and
  /// std::length_error where so many different models are more than one batch can hold.
  explicit ValveBatch(std::span<const Parameters* const> valves,
                      InstructionSet instructions = instruction_sets().back());
  ~ValveBatch();
  ValveBatch(ValveBatch&&) noexcept;
  ValveBatch& operator=(ValveBatch&&) noexcept;

  /// All samples of the rows. Throws std::invalid_argument where rows differ in length or end within a sample.
  void step(const typename BatchedKind<Parameters>::Rows& samples, const EstimateRows& estimates);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

extern template class ValveBatch<sensor::CondensedTables<float>>;
extern template class ValveBatch<sensor::ObserverParameters<float>>;
extern template class ValveBatch<sensor::WholeCondensedTables<float>>;
extern template class ValveBatch<sensor::WholeValveParameters<float>>;

}  // namespace spoolflow::estimation::batch
