#pragma once
/// The steps of a ValveBatch for the instruction set that the including translation unit is compiled for. All that
/// stands here has internal linkage or the target's register in its type.
#include <experimental/simd>
#include <new>

#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/validation/batch_steps.hpp"
#include "spoolflow/validation/pack_tables.hpp"
#include "spoolflow/validation/valve_batch.hpp"

namespace spoolflow::validation {
namespace {

using Register = simd::native_simd<float>;
using Pack = ValvePack<Register, valves_together / Register::size()>;

/// Where one valve's numbers lie, in the order in which they are described: visitor of a description.
class Described {
 public:
  template <class Table>
  void table(const char* /*key*/, const Table& numbers, int /*per_record*/) {
    add(numbers.data());
  }
  template <class Map>
  void map(const char* key, const Map& map, const char* /*row_key*/, const char* column_key) {
    axis(key, map.row_axis, 0);
    axis(column_key, map.column_axis, 0);
    add(map.values.data());
  }
  template <class Curve>
  void curve(const char* /*key*/, const Curve& curve, const char* axis_key) {
    axis(axis_key, curve.axis, 0);
    add(curve.values.data());
  }
  template <class Volume>
  void volume(const char* /*key*/, const Volume& volume) {
    add(volume.values.data());
  }
  void axis(const char* /*key*/, const sensor::Axis<float>& axis, int /*points*/) {
    for (const float* number : {&axis.first, &axis.spacing, &axis.per_spacing}) add(number);
  }
  template <std::size_t Count>
  void list(const char* /*key*/, const std::array<float, Count>& values, double /*lowest*/, double /*highest*/) {
    for (const float& value : values) add(&value);
  }
  void number(const char* /*key*/, const float& value, double /*lowest*/, double /*highest*/) { add(&value); }
  [[nodiscard]] const float* at(std::size_t k) const { return addresses_[k]; }

 private:
  void add(const float* address) { addresses_[count_++] = address; }
  std::array<const float*, 128> addresses_{};
  std::size_t count_ = 0;
};

/// Puts the valves' numbers side by side: visitor of the same description over packs.
class SideBySide {
 public:
  SideBySide(const std::array<Described, valves_together>& valves, const float* numbers)
      : valves_(valves), numbers_(numbers) {}

  template <class Table>
  void table(const char* /*key*/, Table& table, int /*per_record*/) {
    std::array<std::int32_t, valves_together> first;
    for (std::size_t k = 0; k < valves_together; ++k)
      first[k] = static_cast<std::int32_t>(valves_[k].at(next_) - numbers_);
    table.numbers = numbers_;
    table.first = std::bit_cast<Pack::Index>(first);
    ++next_;
  }
  template <class Map>
  void map(const char* key, Map& map, const char* /*row_key*/, const char* column_key) {
    axis(key, map.row_axis, 0);
    axis(column_key, map.column_axis, 0);
    table(key, map.values, 0);
  }
  template <class Curve>
  void curve(const char* key, Curve& curve, const char* axis_key) {
    axis(axis_key, curve.axis, 0);
    table(key, curve.values, 0);
  }
  template <class Volume>
  void volume(const char* key, Volume& volume) {
    table(key, volume.values, 0);
  }
  void axis(const char* key, sensor::Axis<Pack>& axis, int /*points*/) {
    for (Pack* number : {&axis.first, &axis.spacing, &axis.per_spacing}) this->number(key, *number, 0, 0);
  }
  template <std::size_t Count>
  void list(const char* key, std::array<Pack, Count>& values, double lowest, double highest) {
    for (Pack& value : values) number(key, value, lowest, highest);
  }
  void number(const char* /*key*/, Pack& value, double /*lowest*/, double /*highest*/) {
    std::array<float, valves_together> numbers;
    for (std::size_t k = 0; k < valves_together; ++k) numbers[k] = *valves_[k].at(next_);
    value = Pack::read(numbers.data());
    ++next_;
  }

 private:
  const std::array<Described, valves_together>& valves_;
  const float* numbers_;
  std::size_t next_ = 0;
};

/// The valves that are stepped together.
template <class Parameters, class State>
struct Together {
  Parameters parameters;
  State state;
};

/// Valves whose sample is unusable keep what they had before, with the reason as status. Flattened: a call with packs
/// as arguments would carry them through memory.
template <class Valves>
[[gnu::flatten]] inline void step_one(Valves& valves, const sensor::Sample<Pack>& sample) {
  const auto held = sensor::unusable(sample);
  const auto hold = is_any(held);
  if (!any(hold)) {
    sensor::step(valves.parameters, valves.state, sample);
    return;
  }
  const auto before = valves.state;
  sensor::step(valves.parameters, valves.state, sample);
  keep(hold, before, valves.state);
  auto& status = valves.state.last.status;
  auto reason = status;
  reason = held;
  keep(hold, reason, status);
}

template <class Valves>
[[gnu::flatten]] void step_rows(void* memory, const BatchRows& rows) {
  Valves& valves = *static_cast<Valves*>(memory);
  const auto* const last = reinterpret_cast<const char*>(&valves.state.last);
  for (std::size_t k = 0; k < rows.count; ++k) {
    const std::size_t at = k * rows.stride;
    const auto input = [&](std::size_t row) { return Pack::read(rows.samples[row] + at); };
    step_one(valves, {input(0), input(1), input(2), input(3), input(4)});
    for (std::size_t wanted = 0; wanted < rows.wanted; ++wanted) {
      const WantedAnswer& answer = rows.answers[wanted];
      std::memcpy(static_cast<float*>(answer.to) + at, last + answer.number * sizeof(Pack), sizeof(Pack));
    }
  }
}

template <class Float, class Parameters, class State, class Describe>
void begin_valves(void* memory, const void* const* valves, const float* numbers, const Describe& describe) {
  auto& together = *new (memory) Together<Parameters, State>{};
  std::array<Described, valves_together> described{};
  for (std::size_t k = 0; k < valves_together; ++k) describe(*static_cast<const Float*>(valves[k]), described[k]);
  SideBySide side_by_side(described, numbers);
  describe(together.parameters, side_by_side);
}

using CondensedTogether = Together<sensor::CondensedTables<Pack>, sensor::CondensedState<Pack>>;

constexpr BatchSteps condensed_steps{
    sizeof(CondensedTogether), alignof(CondensedTogether),
    [](void* memory, const void* const* valves, const float* numbers) {
      begin_valves<sensor::CondensedTables<float>, sensor::CondensedTables<Pack>, sensor::CondensedState<Pack>>(
          memory, valves, numbers,
          [](auto& tables, auto& visitor) { model::describe_condensed_tables(tables, visitor); });
    },
    step_rows<CondensedTogether>};

using ObserverTogether = Together<sensor::ObserverParameters<Pack>, sensor::ObserverState<Pack>>;

constexpr BatchSteps observer_steps{
    sizeof(ObserverTogether), alignof(ObserverTogether),
    [](void* memory, const void* const* valves, const float* numbers) {
      begin_valves<sensor::ObserverParameters<float>, sensor::ObserverParameters<Pack>, sensor::ObserverState<Pack>>(
          memory, valves, numbers,
          [](auto& parameters, auto& visitor) { model::describe_observer(parameters, visitor); });
    },
    step_rows<ObserverTogether>};

}  // namespace
}  // namespace spoolflow::validation
