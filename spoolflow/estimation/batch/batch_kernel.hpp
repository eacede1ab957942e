#pragma once
/// The steps of a ValveBatch for the instruction set that the including translation unit is compiled for. All that
/// stands here has internal linkage or the target's register in its type.
#include <cstddef>
#include <experimental/simd>

#include "spoolflow/estimation/batch/batch_steps.hpp"
#include "spoolflow/estimation/batch/valve_batch.hpp"
#include "spoolflow/estimation/packs/packs_together.hpp"

namespace spoolflow::estimation::batch {
namespace {

using packs::describe_parameters;
using packs::describe_tables;
using packs::Together;
using packs::WholeTogether;

/// What the steps below take for granted of packs.
template <class Pack>
struct Layout {
  // Rows of numbers are read as packs, and registers of a pack follow each other.
  static_assert(sizeof(Pack) == Pack::Lanes::valves * sizeof(float) && sizeof(typename Pack::Index) == sizeof(Pack));
  // Inputs are given, and answers fetched, by their number.
  using Answers = sensor::Estimate<Pack>;
  static_assert(sizeof(sensor::Sample<Pack>) == 5 * sizeof(Pack) &&
                sizeof(sensor::WholeValveSample<Pack>) == 7 * sizeof(Pack) + sizeof(sensor::PortPressures<Pack>));
  static_assert(sizeof(Answers) == 9 * sizeof(Pack));
  static_assert(offsetof(sensor::Sample<Pack>, current_A) == 1 * sizeof(Pack));
  static_assert(offsetof(sensor::Sample<Pack>, voltage_V) == 2 * sizeof(Pack));
  static_assert(offsetof(sensor::Sample<Pack>, position_m) == 3 * sizeof(Pack));
  static_assert(offsetof(sensor::Sample<Pack>, oil_temperature_K) == 4 * sizeof(Pack));
  static_assert(offsetof(sensor::WholeValveSample<Pack>, current_a_A) == 1 * sizeof(Pack));
  static_assert(offsetof(sensor::WholeValveSample<Pack>, current_b_A) == 2 * sizeof(Pack));
  static_assert(offsetof(sensor::WholeValveSample<Pack>, voltage_a_V) == 3 * sizeof(Pack));
  static_assert(offsetof(sensor::WholeValveSample<Pack>, voltage_b_V) == 4 * sizeof(Pack));
  static_assert(offsetof(sensor::WholeValveSample<Pack>, position_m) == 5 * sizeof(Pack));
  static_assert(offsetof(sensor::WholeValveSample<Pack>, oil_temperature_K) == 6 * sizeof(Pack));
  static_assert(offsetof(Answers, flow_lower_m3_per_s) == 1 * sizeof(Pack));
  static_assert(offsetof(Answers, flow_upper_m3_per_s) == 2 * sizeof(Pack));
  static_assert(offsetof(Answers, pressure_difference_Pa) == 3 * sizeof(Pack));
  static_assert(offsetof(Answers, magnetic_force_N) == 4 * sizeof(Pack));
  static_assert(offsetof(Answers, spring_force_N) == 5 * sizeof(Pack));
  static_assert(offsetof(Answers, flow_force_N) == 6 * sizeof(Pack));
  static_assert(offsetof(Answers, friction_force_N) == 7 * sizeof(Pack));
  static_assert(offsetof(Answers, status) == 8 * sizeof(Pack));
};

template <class Valves>
[[gnu::flatten]] void step_rows(void* memory, const BatchRows& rows) {
  using Pack = typename Valves::Pack;
  static_assert(sizeof(Layout<Pack>) > 0);
  Valves& valves = *static_cast<Valves*>(memory);
  const auto* const last = reinterpret_cast<const char*>(&std::as_const(valves).answer());
  for (std::size_t k = 0; k < rows.count; ++k) {
    const std::size_t at = k * rows.stride;
    step_one(valves, Valves::sample([&](std::size_t row) { return Pack::read(rows.samples[row] + at); }));
    for (std::size_t wanted = 0; wanted < rows.wanted; ++wanted) {
      const WantedAnswer& answer = rows.answers[wanted];
      std::memcpy(static_cast<float*>(answer.to) + at, last + answer.number * sizeof(Pack), sizeof(Pack));
    }
  }
}

template <class Valves, auto describe>
constexpr BatchSteps steps_of_direction{sizeof(Valves), alignof(Valves), Valves::Pack::Lanes::valves,
                                        [](void* memory, const void* const* valves, const float* numbers) {
                                          return packs::begin_valves<Valves>(memory, valves, numbers, describe);
                                        },
                                        step_rows<Valves>};
template <class Valves, auto describe>
constexpr BatchSteps steps_of_whole{sizeof(Valves), alignof(Valves), Valves::Pack::Lanes::valves,
                                    [](void* memory, const void* const* valves, const float* numbers) {
                                      return packs::begin_whole_valves<Valves>(memory, valves, numbers, describe);
                                    },
                                    step_rows<Valves>};

/// The steps of every kind of sensor, in registers of one kind; of those with fewer valves than are stepped together as
/// many as it takes.
template <class Register>
struct StepsIn {
  static constexpr int registers = valves_together > Register::size() ? valves_together / Register::size() : 1;
  using Pack = packs::ValvePack<Register, registers>;

  static constexpr const BatchSteps& condensed =
      steps_of_direction<Together<Pack, sensor::CondensedTables<Pack>, sensor::CondensedState<Pack>>, describe_tables>;
  static constexpr const BatchSteps& observer =
      steps_of_direction<Together<Pack, sensor::ObserverParameters<Pack>, sensor::ObserverState<Pack>>,
                         describe_parameters>;
  static constexpr const BatchSteps& whole_condensed =
      steps_of_whole<WholeTogether<Pack, sensor::WholeCondensedTables<Pack>, sensor::WholeCondensedState<Pack>,
                                   packs::CondensedSides<Register, registers>>,
                     describe_tables>;
  static constexpr const BatchSteps& whole_valve =
      steps_of_whole<WholeTogether<Pack, sensor::WholeValveParameters<Pack>, sensor::WholeValveState<Pack>,
                                   packs::ObserverSides<Register, registers>>,
                     describe_parameters>;
};

}  // namespace
}  // namespace spoolflow::estimation::batch
