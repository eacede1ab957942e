#pragma once
/// The models of several valves put side by side into one that is made of packs. All that stands here has internal
/// linkage or the target's register in its type.
#include <array>
#include <bit>
#include <cstddef>

#include "spoolflow/estimation/packs/pack_tables.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"

namespace spoolflow::estimation::packs {
namespace {

/// Where one valve's numbers lie, in the order in which they are described: visitor of a description that names
/// `Capacity` numbers and tables at most.
template <class Number, std::size_t Capacity>
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
  void axis(const model::AxisParameter& /*about*/, const sensor::Axis<Number>& axis, int /*points*/) {
    for (const Number* number : {&axis.first, &axis.spacing, &axis.per_spacing}) add(number);
  }
  template <std::size_t Count>
  void list(const model::Parameter& /*about*/, const std::array<Number, Count>& values) {
    for (const Number& value : values) add(&value);
  }
  void number(const model::Parameter& /*about*/, const Number& value) { add(&value); }
  [[nodiscard]] const Number* at(std::size_t k) const { return addresses_[k]; }
  [[nodiscard]] bool all_held() const { return count_ <= Capacity; }

 private:
  void add(const Number* address) {
    if (count_ < Capacity) addresses_[count_] = address;
    ++count_;
  }
  std::array<const Number*, Capacity> addresses_{};
  std::size_t count_ = 0;
};

/// Puts the valves' numbers side by side: visitor of the same description over packs.
template <class Pack, std::size_t Capacity>
class SideBySide {
 public:
  using Number = typename Pack::Number;
  static constexpr std::size_t valves_together = Pack::Lanes::valves;
  using Valves = std::array<Described<Number, Capacity>, valves_together>;
  SideBySide(const Valves& valves, const Number* numbers) : valves_(valves), numbers_(numbers) {}

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
    using Integer = typename Pack::Lanes::Integer;
    std::array<Integer, valves_together> first;
    for (std::size_t k = 0; k < valves_together; ++k) first[k] = static_cast<Integer>(valves_[k].at(next_) - numbers_);
    table.numbers = numbers_;
    table.first = std::bit_cast<typename Pack::Index>(first);
    ++next_;
  }
  void put_number(Pack& value) {
    std::array<Number, valves_together> numbers;
    for (std::size_t k = 0; k < valves_together; ++k) numbers[k] = *valves_[k].at(next_);
    value = Pack::read(numbers.data());
    ++next_;
  }

  const Valves& valves_;
  const Number* numbers_;
  std::size_t next_ = 0;
};

/// Puts the numbers of `valves` side by side into `parameters`.
template <class Pack, template <class> class Parameters, class Describe>
bool put_together(Parameters<Pack>& parameters, const void* const* valves, const typename Pack::Number* numbers,
                  const Describe& describe) {
  // Each number is a pack of the parameters, each table more than one: described once, they cannot be more.
  using Number = typename Pack::Number;
  constexpr std::size_t capacity = sizeof(Parameters<Pack>) / sizeof(Pack);
  std::array<Described<Number, capacity>, Pack::Lanes::valves> described{};
  for (std::size_t k = 0; k < described.size(); ++k)
    describe(*static_cast<const Parameters<Number>*>(valves[k]), described[k]);
  if (!described[0].all_held()) return false;
  SideBySide<Pack, capacity> side_by_side(described, numbers);
  describe(parameters, side_by_side);
  return true;
}

constexpr auto describe_tables = [](auto& tables, auto& visitor) { model::describe_condensed_tables(tables, visitor); };
constexpr auto describe_parameters = [](auto& parameters, auto& visitor) {
  model::describe_observer(parameters, visitor);
};

}  // namespace
}  // namespace spoolflow::estimation::packs
