#pragma once
/// The steps of sensors in double precision for the instruction set that the including translation unit is compiled
/// for. All that stands here has internal linkage or the target's register in its type.
#include <cstddef>
#include <experimental/simd>

#include "spoolflow/estimation/packs/group_steps.hpp"
#include "spoolflow/estimation/packs/packs_together.hpp"

namespace spoolflow::estimation::packs {
namespace {

/// One number of a valve's state, as the lane of a pack has it.
template <class Number, class Lane>
void load_numbers(const char* from, double* lane, std::size_t valves, std::size_t count, const Lane& as_lane) {
  for (std::size_t k = 0; k < count; ++k) {
    Number number;
    std::memcpy(&number, from + k * sizeof number, sizeof number);
    lane[k * valves] = std::bit_cast<double>(as_lane(number));
  }
}
template <class Number, class Lane>
void store_numbers(char* to, const double* lane, std::size_t valves, std::size_t count, const Lane& of_lane) {
  for (std::size_t k = 0; k < count; ++k) {
    const Number number = of_lane(lane[k * valves]);
    std::memcpy(to + k * sizeof number, &number, sizeof number);
  }
}

template <std::size_t valves>
void load_lane(double* lane, const char* state, std::span<const NumberRun> runs) {
  const auto whole = [](auto number) { return static_cast<std::int64_t>(number); };
  for (const NumberRun& run : runs) {
    const char* const from = state + run.offset;
    switch (run.kind) {
      case NumberKind::number:
        load_numbers<double>(from, lane, valves, run.count, [](double number) { return number; });
        break;
      case NumberKind::truth:
        load_numbers<bool>(from, lane, valves, run.count, [](bool holds) { return -std::int64_t{holds}; });
        break;
      case NumberKind::whole:
        load_numbers<int>(from, lane, valves, run.count, whole);
        break;
      case NumberKind::motion:
        load_numbers<sensor::Motion>(from, lane, valves, run.count, whole);
        break;
      case NumberKind::word:
        load_numbers<sensor::Status>(from, lane, valves, run.count, whole);
        break;
    }
    lane += run.count * valves;
  }
}

template <std::size_t valves>
void store_lane(const double* lane, char* state, std::span<const NumberRun> runs) {
  const auto as = []<class Number>(Number /*kind*/) {
    return [](double number) { return static_cast<Number>(std::bit_cast<std::int64_t>(number)); };
  };
  for (const NumberRun& run : runs) {
    char* const to = state + run.offset;
    switch (run.kind) {
      case NumberKind::number:
        store_numbers<double>(to, lane, valves, run.count, [](double number) { return number; });
        break;
      case NumberKind::truth:
        store_numbers<bool>(to, lane, valves, run.count, as(bool{}));
        break;
      case NumberKind::whole:
        store_numbers<int>(to, lane, valves, run.count, as(int{}));
        break;
      case NumberKind::motion:
        store_numbers<sensor::Motion>(to, lane, valves, run.count, as(sensor::Motion{}));
        break;
      case NumberKind::word:
        store_numbers<sensor::Status>(to, lane, valves, run.count, as(sensor::Status{}));
        break;
    }
    lane += run.count * valves;
  }
}

template <class Valves>
[[gnu::flatten]] void step_samples(void* memory, const double* samples, double* answers, std::size_t count) {
  using Pack = typename Valves::Pack;
  constexpr std::size_t valves = Pack::Lanes::valves, channels = Valves::channels;
  static_assert(sizeof(sensor::Estimate<Pack>) == numbers_of_an_answer * sizeof(Pack));
  Valves& together = *static_cast<Valves*>(memory);
  for (std::size_t k = 0; k < count; ++k) {
    const double* const at = samples + k * channels * valves;
    step_one(together, Valves::sample([&](std::size_t channel) { return Pack::read(at + channel * valves); }));
    std::memcpy(answers + k * numbers_of_an_answer * valves, &std::as_const(together).answer(),
                sizeof(sensor::Estimate<Pack>));
  }
}

/// The first numbers of the first valve are where places in tables are counted from.
template <class Valves>
bool begin_group(void* memory, const void* const* valves) {
  const auto* const numbers = static_cast<const double*>(valves[0]);
  if constexpr (requires { Valves::sides; }) {
    return begin_whole_valves<Valves>(memory, valves, numbers, describe_parameters);
  } else {
    return begin_valves<Valves>(memory, valves, numbers, describe_parameters);
  }
}

template <class Valves>
constexpr GroupSteps group_steps_of() {
  using Pack = typename Valves::Pack;
  constexpr std::size_t valves = Pack::Lanes::valves;
  using State = decltype(Valves::state);
  return {sizeof(Valves),
          alignof(Valves),
          valves,
          Valves::channels,
          sizeof(State) / sizeof(Pack),
          begin_group<Valves>,
          [](void* memory, std::size_t valve, const void* state, std::span<const NumberRun> runs) {
            auto* const lanes = reinterpret_cast<double*>(&static_cast<Valves*>(memory)->state);
            load_lane<valves>(lanes + valve, static_cast<const char*>(state), runs);
          },
          [](const void* memory, std::size_t valve, void* state, std::span<const NumberRun> runs) {
            const auto* const lanes = reinterpret_cast<const double*>(&static_cast<const Valves*>(memory)->state);
            store_lane<valves>(lanes + valve, static_cast<char*>(state), runs);
          },
          step_samples<Valves>};
}

template <class Register, int registers>
using ObserversTogether =
    Together<ValvePack<Register, registers>, sensor::ObserverParameters<ValvePack<Register, registers>>,
             sensor::ObserverState<ValvePack<Register, registers>>>;
template <class Register, int registers>
using WholeValvesTogether =
    WholeTogether<ValvePack<Register, registers>, sensor::WholeValveParameters<ValvePack<Register, registers>>,
                  sensor::WholeValveState<ValvePack<Register, registers>>, ObserverSides<Register, registers>>;

}  // namespace
}  // namespace spoolflow::estimation::packs
