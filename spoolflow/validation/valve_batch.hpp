#pragma once
/// Several valves stepped at once on one core, each with its own model.
#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/validation/valve_pack.hpp"

namespace spoolflow::validation {

/// One valve's numbers in the order in which they are described: visitor of describe_condensed_tables.
struct DescribedInOrder {
  std::vector<const float*> tables;
  std::vector<float> numbers;

  template <class Table>
  void table(std::string_view /*key*/, const Table& table, int /*per_record*/) {
    tables.push_back(table.data());
  }
  void number(std::string_view /*key*/, float value, double /*lowest*/, double /*highest*/) {
    numbers.push_back(value);
  }
};

/// Puts several valves' numbers side by side: visitor of describe_condensed_tables over packs.
template <int N>
class SideBySide {
 public:
  explicit SideBySide(const std::array<DescribedInOrder, N>& valves) : valves_(valves) {}

  void table(std::string_view /*key*/, PackTable<N>& table, int /*per_record*/) {
    for (std::size_t k = 0; k < N; ++k) table.of_valve[k] = valves_[k].tables[tables_];
    ++tables_;
  }
  void number(std::string_view /*key*/, ValvePack<N>& value, double /*lowest*/, double /*highest*/) {
    std::array<float, N> out;
    for (std::size_t k = 0; k < N; ++k) out[k] = valves_[k].numbers[numbers_];
    value = ValvePack<N>(out);
    ++numbers_;
  }

 private:
  const std::array<DescribedInOrder, N>& valves_;
  std::size_t tables_ = 0;
  std::size_t numbers_ = 0;
};

/// Condensed sensors of N valves, in single precision: what it answers is what N sensors of float answer.
template <int N>
class ValveBatch {
 public:
  using Pack = ValvePack<N>;

  /// Keeps references to the valves' tables; the same valve may stand in several places.
  explicit ValveBatch(const std::array<const sensor::CondensedTables<float>*, N>& valves) {
    std::array<DescribedInOrder, N> described;
    for (std::size_t k = 0; k < N; ++k) model::describe_condensed_tables(*valves[k], described[k]);
    model::describe_condensed_tables(tables_, SideBySide<N>(described));
  }

  /// Flattened: a call with packs as arguments would carry them through memory.
  [[gnu::flatten]] const sensor::Estimate<Pack>& step(const sensor::Sample<Pack>& sample) {
    sensor::step(tables_, state_, sample);
    return state_.last;
  }

 private:
  sensor::CondensedTables<Pack> tables_;
  sensor::CondensedState<Pack> state_;
};

}  // namespace spoolflow::validation
