#pragma once
/// The steps of a ValveBatch for the instruction set that the including translation unit is compiled for. All that
/// stands here has internal linkage or the target's register in its type.
#include <concepts>
#include <cstddef>
#include <experimental/simd>
#include <new>

#include "spoolflow/estimation/batch/batch_steps.hpp"
#include "spoolflow/estimation/batch/pack_sides.hpp"
#include "spoolflow/estimation/batch/valve_batch.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/sensor/condensed.hpp"

namespace spoolflow::estimation::batch {
namespace {

using Register = simd::native_simd<float>;
using Pack = ValvePack<Register, valves_together / Register::size()>;

// Rows of numbers are read as packs, and registers of a pack follow each other.
static_assert(sizeof(Pack) == valves_together * sizeof(float) && sizeof(Pack::Index) == sizeof(Pack));
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

/// Where one valve's numbers lie, in the order in which they are described: visitor of a description that names
/// `Capacity` numbers and tables at most.
template <std::size_t Capacity>
class Described {
 public:
  template <class Table>
  void table(const char* /*key*/, const Table& numbers, int /*per_record*/) {
    add(numbers.data());
  }
  template <class Map>
  void map(const model::TableParameter& about, const Map& map) {
    axis(about.rows, map.row_axis, 0);
    axis(about.columns, map.column_axis, 0);
    add(map.values.data());
  }
  template <class Curve>
  void curve(const model::TableParameter& about, const Curve& curve) {
    axis(about.columns, curve.axis, 0);
    add(curve.values.data());
  }
  template <class Volume>
  void volume(const model::TableParameter& /*about*/, const Volume& volume) {
    add(volume.values.data());
  }
  void axis(const model::AxisParameter& /*about*/, const sensor::Axis<float>& axis, int /*points*/) {
    for (const float* number : {&axis.first, &axis.spacing, &axis.per_spacing}) add(number);
  }
  template <std::size_t Count>
  void list(const model::Parameter& /*about*/, const std::array<float, Count>& values) {
    for (const float& value : values) add(&value);
  }
  void number(const model::Parameter& /*about*/, const float& value) { add(&value); }
  [[nodiscard]] const float* at(std::size_t k) const { return addresses_[k]; }
  [[nodiscard]] bool all_held() const { return count_ <= Capacity; }

 private:
  void add(const float* address) {
    if (count_ < Capacity) addresses_[count_] = address;
    ++count_;
  }
  std::array<const float*, Capacity> addresses_{};
  std::size_t count_ = 0;
};

/// Puts the valves' numbers side by side: visitor of the same description over packs.
template <std::size_t Capacity>
class SideBySide {
 public:
  SideBySide(const std::array<Described<Capacity>, valves_together>& valves, const float* numbers)
      : valves_(valves), numbers_(numbers) {}

  template <class Table>
  void table(const char* /*key*/, Table& table, int /*per_record*/) {
    put(table);
  }
  template <class Map>
  void map(const model::TableParameter& about, Map& map) {
    axis(about.rows, map.row_axis, 0);
    axis(about.columns, map.column_axis, 0);
    put(map.values);
  }
  template <class Curve>
  void curve(const model::TableParameter& about, Curve& curve) {
    axis(about.columns, curve.axis, 0);
    put(curve.values);
  }
  template <class Volume>
  void volume(const model::TableParameter& /*about*/, Volume& volume) {
    put(volume.values);
  }
  void axis(const model::AxisParameter& /*about*/, sensor::Axis<Pack>& axis, int /*points*/) {
    for (Pack* number : {&axis.first, &axis.spacing, &axis.per_spacing}) put_number(*number);
  }
  template <std::size_t Count>
  void list(const model::Parameter& /*about*/, std::array<Pack, Count>& values) {
    for (Pack& value : values) put_number(value);
  }
  void number(const model::Parameter& /*about*/, Pack& value) { put_number(value); }

 private:
  template <class Table>
  void put(Table& table) {
    std::array<std::int32_t, valves_together> first;
    for (std::size_t k = 0; k < valves_together; ++k)
      first[k] = static_cast<std::int32_t>(valves_[k].at(next_) - numbers_);
    table.numbers = numbers_;
    table.first = std::bit_cast<Pack::Index>(first);
    ++next_;
  }
  void put_number(Pack& value) {
    std::array<float, valves_together> numbers;
    for (std::size_t k = 0; k < valves_together; ++k) numbers[k] = *valves_[k].at(next_);
    value = Pack::read(numbers.data());
    ++next_;
  }

  const std::array<Described<Capacity>, valves_together>& valves_;
  const float* numbers_;
  std::size_t next_ = 0;
};

/// The valves that are stepped together.
template <class Parameters, class State, class SampleOfAll>
struct Together {
  using Sample = SampleOfAll;
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
template <class Parameters, class State, class Sides>
struct WholeTogether : Together<Parameters, State, sensor::WholeValveSample<Pack>> {
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

template <class Valves>
[[gnu::flatten]] void step_rows(void* memory, const BatchRows& rows) {
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

/// Puts the numbers of `valves` side by side into `parameters`.
template <class Float, class Parameters, class Describe>
bool put_together(Parameters& parameters, const void* const* valves, const float* numbers, const Describe& describe) {
  // Each number is a pack of the parameters, each table more than one: described once, they cannot be more.
  constexpr std::size_t capacity = sizeof(Parameters) / sizeof(Pack);
  std::array<Described<capacity>, valves_together> described{};
  for (std::size_t k = 0; k < valves_together; ++k) describe(*static_cast<const Float*>(valves[k]), described[k]);
  if (!described[0].all_held()) return false;
  SideBySide<capacity> side_by_side(described, numbers);
  describe(parameters, side_by_side);
  return true;
}

template <class Valves, class Float, class Describe>
bool begin_valves(void* memory, const void* const* valves, const float* numbers, const Describe& describe) {
  return put_together<Float>((new (memory) Valves{})->parameters, valves, numbers, describe);
}

/// Flattened: a constructor of its own would be a function that others may share.
template <class Valves, class Float, class Describe>
[[gnu::flatten]] bool begin_whole_valves(void* memory, const void* const* valves, const float* numbers,
                                         const Describe& describe) {
  auto& together = *new (memory) Valves{};
  auto& sides = together.sides;
  if (!put_together<Float>(sides.b, valves, numbers, describe) ||
      !put_together<Float>(sides.a, valves + valves_together, numbers, describe)) {
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

constexpr auto describe_tables = [](auto& tables, auto& visitor) { model::describe_condensed_tables(tables, visitor); };
constexpr auto describe_parameters = [](auto& parameters, auto& visitor) {
  model::describe_observer(parameters, visitor);
};

using CondensedTogether = Together<sensor::CondensedTables<Pack>, sensor::CondensedState<Pack>, sensor::Sample<Pack>>;
constexpr BatchSteps condensed_steps{sizeof(CondensedTogether), alignof(CondensedTogether),
                                     [](void* memory, const void* const* valves, const float* numbers) {
                                       return begin_valves<CondensedTogether, sensor::CondensedTables<float>>(
                                           memory, valves, numbers, describe_tables);
                                     },
                                     step_rows<CondensedTogether>};

using ObserverTogether = Together<sensor::ObserverParameters<Pack>, sensor::ObserverState<Pack>, sensor::Sample<Pack>>;
constexpr BatchSteps observer_steps{sizeof(ObserverTogether), alignof(ObserverTogether),
                                    [](void* memory, const void* const* valves, const float* numbers) {
                                      return begin_valves<ObserverTogether, sensor::ObserverParameters<float>>(
                                          memory, valves, numbers, describe_parameters);
                                    },
                                    step_rows<ObserverTogether>};

constexpr int registers = valves_together / static_cast<int>(Register::size());
using WholeCondensedTogether = WholeTogether<sensor::WholeCondensedTables<Pack>, sensor::WholeCondensedState<Pack>,
                                             CondensedSides<Register, registers>>;
constexpr BatchSteps whole_condensed_steps{
    sizeof(WholeCondensedTogether), alignof(WholeCondensedTogether),
    [](void* memory, const void* const* valves, const float* numbers) {
      return begin_whole_valves<WholeCondensedTogether, sensor::CondensedTables<float>>(memory, valves, numbers,
                                                                                        describe_tables);
    },
    step_rows<WholeCondensedTogether>};

using WholeValveTogether = WholeTogether<sensor::WholeValveParameters<Pack>, sensor::WholeValveState<Pack>,
                                         ObserverSides<Register, registers>>;
constexpr BatchSteps whole_valve_steps{
    sizeof(WholeValveTogether), alignof(WholeValveTogether),
    [](void* memory, const void* const* valves, const float* numbers) {
      return begin_whole_valves<WholeValveTogether, sensor::ObserverParameters<float>>(memory, valves, numbers,
                                                                                       describe_parameters);
    },
    step_rows<WholeValveTogether>};

}  // namespace
}  // namespace spoolflow::estimation::batch
