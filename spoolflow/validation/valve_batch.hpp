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

/// One valve's parameters in the order in which they are described: visitor of describe_condensed.
struct DescribedInOrder {
  std::vector<const float*> tables;
  std::vector<sensor::Axis<float>> axes;
  std::vector<float> numbers;

  template <class Map>
  void map(std::string_view /*key*/, const Map& map, std::string_view /*rows*/, std::string_view /*columns*/) {
    axes.push_back(map.row_axis);
    axes.push_back(map.column_axis);
    tables.push_back(map.values.data());
  }
  template <class Curve>
  void curve(std::string_view /*key*/, const Curve& curve, std::string_view /*axis*/) {
    axes.push_back(curve.axis);
    tables.push_back(curve.values.data());
  }
  void number(std::string_view /*key*/, float value, double /*lowest*/, double /*highest*/) {
    numbers.push_back(value);
  }
};

/// Puts several valves' parameters side by side: visitor of describe_condensed over packs.
template <int N>
class SideBySide {
 public:
  explicit SideBySide(const std::array<DescribedInOrder, N>& valves) : valves_(valves) {}

  template <class Map>
  void map(std::string_view /*key*/, Map& map, std::string_view /*rows*/, std::string_view /*columns*/) {
    axis(map.row_axis);
    axis(map.column_axis);
    table(map.values);
  }
  template <class Curve>
  void curve(std::string_view /*key*/, Curve& curve, std::string_view /*axis*/) {
    axis(curve.axis);
    table(curve.values);
  }
  void number(std::string_view /*key*/, ValvePack<N>& value, double /*lowest*/, double /*highest*/) {
    value = pack([this](const DescribedInOrder& valve) { return valve.numbers[numbers_]; });
    ++numbers_;
  }

 private:
  template <class Of>
  ValvePack<N> pack(const Of& of) const {
    std::array<float, N> out;
    for (std::size_t k = 0; k < N; ++k) out[k] = of(valves_[k]);
    return ValvePack<N>(out);
  }
  void axis(sensor::Axis<ValvePack<N>>& axis) {
    axis.first = pack([this](const DescribedInOrder& valve) { return valve.axes[axes_].first; });
    axis.spacing = pack([this](const DescribedInOrder& valve) { return valve.axes[axes_].spacing; });
    axis.per_spacing = pack([this](const DescribedInOrder& valve) { return valve.axes[axes_].per_spacing; });
    ++axes_;
  }
  void table(PackTable<N>& table) {
    for (std::size_t k = 0; k < N; ++k) table.of_valve[k] = valves_[k].tables[tables_];
    ++tables_;
  }

  const std::array<DescribedInOrder, N>& valves_;
  std::size_t tables_ = 0;
  std::size_t axes_ = 0;
  std::size_t numbers_ = 0;
};

/// Condensed sensors of N valves, in single precision: what it answers is what N sensors of float answer.
template <int N>
class ValveBatch {
 public:
  using Pack = ValvePack<N>;

  /// Keeps references to the valves' parameters; the same valve may stand in several places.
  explicit ValveBatch(const std::array<const sensor::CondensedParameters<float>*, N>& valves) {
    std::array<DescribedInOrder, N> described;
    for (std::size_t k = 0; k < N; ++k) model::describe_condensed(*valves[k], described[k]);
    model::describe_condensed(parameters_, SideBySide<N>(described));
  }

  /// Flattened: a call with packs as arguments would carry them through memory.
  [[gnu::flatten]] const sensor::Estimate<Pack>& step(const sensor::Sample<Pack>& sample) {
    sensor::step(parameters_, state_, sample);
    return state_.last;
  }

 private:
  sensor::CondensedParameters<Pack> parameters_;
  sensor::CondensedState<Pack> state_;
};

}  // namespace spoolflow::validation
