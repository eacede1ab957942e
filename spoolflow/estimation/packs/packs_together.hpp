#pragma once
/// Several valves' sensors as one that is made of packs, and its step. All that stands here has internal linkage or the
/// target's register in its type.
#include <concepts>
#include <new>
#include <utility>

#include "spoolflow/estimation/packs/pack_parameters.hpp"
#include "spoolflow/estimation/packs/pack_sides.hpp"
#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::estimation::packs {
namespace {

/// The valves that are stepped together.
template <class PackOfValves, class Parameters, class State, class SampleOfAll = sensor::Sample<PackOfValves>>
struct Together {
  using Pack = PackOfValves;
  using Sample = SampleOfAll;
  static constexpr std::size_t channels = 5;
  template <class Input>
  static Sample sample(const Input& input) {
    return {input(0), input(1), input(2), input(3), input(4)};
  }
  Parameters parameters;
  State state;
  static auto unusable(const Sample& sample) { return sensor::unusable(sample); }
  [[nodiscard]] const sensor::Estimate<Pack>& answer() const { return state.last; }
  sensor::Estimate<Pack>& answer() { return state.last; }
};

/// The same of whole valves; the parameters refer to the sides.
template <class PackOfValves, class Parameters, class State, class Sides>
struct WholeTogether : Together<PackOfValves, Parameters, State, sensor::WholeValveSample<PackOfValves>> {
  using Pack = PackOfValves;
  static constexpr std::size_t channels = 7;
  Sides sides;
  /// Without port pressures.
  template <class Input>
  static sensor::WholeValveSample<Pack> sample(const Input& input) {
    return {input(0), input(1), input(2), input(3), input(4), input(5), input(6)};
  }
  /// The condensed sensor needs the current of the side on which the spool stands, and no other.
  static auto unusable(const sensor::WholeValveSample<Pack>& sample) {
    if constexpr (std::same_as<State, sensor::WholeCondensedState<Pack>>) {
      return sensor::unusable(sample_of(sample, sample.position_m < Pack(0)));
    } else {
      return sensor::unusable(sample);
    }
  }
  [[nodiscard]] const sensor::Estimate<Pack>& answer() const { return last_of(this->state); }
  sensor::Estimate<Pack>& answer() { return last_of(this->state); }

 private:
  template <class Whole>
  static auto& last_of(Whole& state) {
    if constexpr (requires { state.open.last; }) {
      return state.open.last;
    } else {
      return state.last;
    }
  }
};

/// Valves whose sample is unusable hold what they answered before. Flattened: a call with packs as arguments would
/// carry them through memory.
template <class Valves>
[[gnu::flatten]] inline void step_one(Valves& valves, const typename Valves::Sample& sample) {
  const auto held = is_any(Valves::unusable(sample));
  if (!any(held)) {
    sensor::step(valves.parameters, valves.state, sample);
    return;
  }
  auto before = valves.state;
  sensor::hold(valves.parameters, before, sample);
  sensor::step(valves.parameters, valves.state, sample);
  keep(held, before, valves.state);
}

template <class Valves, class Describe>
bool begin_valves(void* memory, const void* const* valves, const typename Valves::Pack::Number* numbers,
                  const Describe& describe) {
  return put_together<typename Valves::Pack>((new (memory) Valves{})->parameters, valves, numbers, describe);
}

/// Flattened: a constructor of its own would be a function that others may share.
template <class Valves, class Describe>
[[gnu::flatten]] bool begin_whole_valves(void* memory, const void* const* valves,
                                         const typename Valves::Pack::Number* numbers, const Describe& describe) {
  auto& together = *new (memory) Valves{};
  auto& sides = together.sides;
  if (!put_together<typename Valves::Pack>(sides.b, valves, numbers, describe) ||
      !put_together<typename Valves::Pack>(sides.a, valves + Valves::Pack::Lanes::valves, numbers, describe)) {
    return false;
  }
  sides.begin();
  together.parameters.sides = &sides;
  if constexpr (requires { together.parameters.b; }) {
    together.parameters.b = &sides.b;
    together.parameters.a = &sides.a;
  }
  return true;
}

}  // namespace
}  // namespace spoolflow::estimation::packs
