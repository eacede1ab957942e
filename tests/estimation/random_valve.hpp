#pragma once
/// Valves whose numbers are as random as their descriptions allow, and samples that are anything at all.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::estimation {

using model::AxisParameter;
using model::Limits;
using model::Parameter;
using model::Relation;
using model::TableParameter;

/// The same numbers on every machine: the standard's distributions differ from library to library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t bits() { return engine_(); }
  /// 0 to 1.
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  bool one_in(unsigned count) { return engine_() % count == 0; }
  double between(double lowest, double highest) { return lowest + share() * (highest - lowest); }
  /// In limits: evenly, by orders of magnitude, or at an end.
  double within(const Limits& limits) {
    const auto [lowest, highest] = limits;
    switch (engine_() % 8) {
      case 0:
        return lowest;
      case 1:
        return highest;
      case 2:
        return between(lowest, highest);
      default: {
        const double largest = std::max(std::abs(lowest), std::abs(highest));
        const double size = largest * std::pow(10.0, -12 * share());
        const double value = lowest < 0 && (highest <= 0 || one_in(2)) ? -size : size;
        return std::clamp(value, lowest, highest);
      }
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// Visitor of a description: fills every number at random, as its limits and relations allow.
class RandomNumbers {
 public:
  explicit RandomNumbers(Dice& dice) : dice_(dice) {}

  template <class T>
  void number(const Parameter& about, T& value) {
    value = static_cast<T>(dice_.within(about.limits));
    if (about.relation.kind == Relation::Kind::not_above) not_above_[about.relation.other].push_back(&value);
    for (double* const other : not_above_[about.key]) *other = std::min(*other, value);
  }
  template <class T, std::size_t Count>
  void list(const Parameter& about, std::array<T, Count>& values) {
    for (T& value : values) value = static_cast<T>(dice_.within(about.limits));
    if (about.relation.kind == Relation::Kind::rises) {
      std::sort(values.begin(), values.end());
      for (std::size_t k = 1; k < Count; ++k)
        values[k] = std::max(values[k], std::nextafter(values[k - 1], std::numeric_limits<T>::max()));
      for (std::size_t k = Count; k-- > 0;)
        values[k] =
            std::min(values[k], static_cast<T>(about.limits.highest) * (1 - 1e-6 * static_cast<T>(Count - 1 - k)));
    }
    if (about.relation.kind == Relation::Kind::sum_not_negative) {
      const auto& held = lists_.at(about.relation.other);
      for (std::size_t k = 0; k < Count; ++k) values[k] = std::max(values[k], -held[k]);
    }
    lists_[about.key] = {values.begin(), values.end()};
  }
  template <class T>
  void axis(const AxisParameter& about, sensor::Axis<T>& axis, int points) {
    const auto [lowest, highest] = about.limits;
    const double from = std::max(lowest, 0.0), least = 1.01 * about.least_step * (points - 1);
    const double end = std::max(from + least, highest * (1 - 1e-6) * std::pow(10.0, -4 * dice_.share()));
    const double first =
        std::clamp(dice_.one_in(2) ? from : end - dice_.between(0, 1.5) * (end - from), lowest, end - least);
    const double spacing = (end - first) / (points - 1);
    axis = {static_cast<T>(first), static_cast<T>(spacing), static_cast<T>(1 / spacing)};
  }
  template <class T, int Points>
  void curve(const TableParameter& about, sensor::Curve<T, Points>& curve) {
    axis(about.columns, curve.axis, Points);
    fill(about, curve.values);
    if (about.relation.kind != Relation::Kind::alike) return;
    const double most = 0.999 * about.relation.least;
    for (std::size_t k = 1; k < curve.values.size(); ++k)
      curve.values[k] = std::clamp(curve.values[k], curve.values[k - 1] / most, curve.values[k - 1] * most);
  }
  template <class T, int Rows, int Columns>
  void map(const TableParameter& about, sensor::Map<T, Rows, Columns>& map) {
    axis(about.rows, map.row_axis, Rows);
    axis(about.columns, map.column_axis, Columns);
    fill(about, map.values);
    if (about.relation.kind == Relation::Kind::never_falls) {
      for (int row = 0; row < Rows; ++row) std::sort(&map.node(row, 0), &map.node(row, 0) + Columns);
    }
    if (about.relation.kind == Relation::Kind::rises_over_rows) {
      const double size = about.limits.highest * std::pow(10.0, -6 * dice_.share()) / Rows;
      for (int column = 0; column < Columns; ++column) {
        double value = dice_.between(-0.5, 0) * size;
        for (int row = 0; row < Rows; ++row) {
          map.node(row, column) = value;
          value += size * std::max(1.1 * about.relation.least * Rows, std::pow(10.0, -4 * dice_.share()));
        }
      }
    }
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const TableParameter& about, sensor::Volume<T, Layers, Rows, Columns>& volume) {
    fill(about, volume.values);
  }

 private:
  /// A table is wild, smooth, or all the same.
  template <class Values>
  void fill(const TableParameter& about, Values& values) {
    const double base = dice_.within(about.limits), other = dice_.within(about.limits);
    const std::uint64_t kind = dice_.bits() % 3;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(values.size());
      values[k] = kind == 0 ? dice_.within(about.limits) : kind == 1 ? base + share * (other - base) : base;
    }
  }

  Dice& dice_;
  std::map<std::string, std::vector<double*>> not_above_;
  std::map<std::string, std::vector<double>> lists_;
};

/// Samples of which most are plausible and the others anything: not a number, infinite, huge, denormal, any bits; times
/// that repeat, run backwards, leap.
class RandomSamples {
 public:
  RandomSamples(Dice& dice, double largest_current_A, double largest_position_m)
      : dice_(dice), largest_current_A_(largest_current_A), largest_position_m_(largest_position_m) {}

  TimedSample next() {
    advance();
    current_A_ = std::clamp(current_A_ + dice_.between(-0.1, 0.1) * largest_current_A_, 0.0, 1.2 * largest_current_A_);
    if (dice_.one_in(20)) velocity_m_ = dice_.one_in(3) ? 0 : dice_.between(-0.02, 0.02) * largest_position_m_;
    position_m_ = std::clamp(position_m_ + velocity_m_, -0.1 * largest_position_m_, 1.1 * largest_position_m_);
    return {odd_or(time_s_), odd_or(current_A_), odd_or(dice_.between(-24, 24)), odd_or(position_m_),
            odd_or(dice_.between(270, 370))};
  }

 private:
  void advance() {
    switch (dice_.bits() % 64) {
      case 0:
        break;
      case 1:
        time_s_ -= dice_.share();
        break;
      case 2:
        time_s_ += 1e3 * dice_.share();
        break;
      case 3:
        time_s_ = std::nextafter(time_s_, 1e300);
        break;
      default:
        time_s_ += step_s_;
    }
    if (dice_.one_in(200)) step_s_ = std::pow(10.0, dice_.between(-6, 0));
  }
  double odd_or(double usual) {
    if (!dice_.one_in(40)) return usual;
    using Limit = std::numeric_limits<double>;
    const double extreme[] = {Limit::quiet_NaN(),
                              Limit::infinity(),
                              -Limit::infinity(),
                              Limit::max(),
                              Limit::lowest(),
                              Limit::denorm_min(),
                              -Limit::denorm_min(),
                              0.0,
                              -0.0,
                              1e9,
                              -1e9,
                              1e-40,
                              -1e8,
                              1e6,
                              std::bit_cast<double>(dice_.bits()),
                              static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(dice_.bits())))};
    return extreme[dice_.bits() % std::size(extreme)];
  }

  Dice& dice_;
  double largest_current_A_, largest_position_m_;
  double time_s_ = 0, step_s_ = 1e-3, current_A_ = 0, position_m_ = 0, velocity_m_ = 0;
};

inline void describe(auto& valve, auto& visitor) requires requires {
  valve.closed_below_m;
  valve.flow_rate;
}
{ model::describe_condensed(valve, visitor); }
inline void describe(auto& valve, auto& visitor) requires requires {
  valve.actuator;
}
{ model::describe_observer(valve, visitor); }

inline void fill(auto& valve, Dice& dice) {
  RandomNumbers numbers(dice);
  describe(valve, numbers);
}

inline double largest_current_A(const sensor::CondensedParameters<double>& valve) {
  return valve.magnetic_force.map.row_axis.at(sensor::force_map_currents - 1);
}
inline double largest_current_A(const sensor::ObserverParameters<double>& valve) {
  return valve.actuator.magnetic_force.map.row_axis.at(sensor::force_map_currents - 1);
}
inline double largest_position_m(const sensor::CondensedParameters<double>& valve) {
  return valve.flow_rate.flow_m3_per_s.row_axis.at(sensor::flow_map_positions - 1);
}
inline double largest_position_m(const sensor::ObserverParameters<double>& valve) {
  return valve.edge.position_m.at(sensor::edge_positions - 1);
}

/// A whole model, as a file would hold it.
inline model::Model random_model(std::uint64_t seed) {
  Dice dice(seed);
  model::Model model{};
  model.valve = {"random", 1e-3, 2e-3, "b"};
  model.provenance = {"0", "2026-01-01T00:00:00Z", {}};
  model.condensed.current_A = model.condensed.position_m = model.condensed.pressure_difference_Pa = {0, 1};
  fill(model.condensed.parameters, dice);
  model.observer.emplace();
  model.observer->oil_temperature_K = {300, 340};
  fill(model.observer->parameters, dice);
  return model;
}

}  // namespace spoolflow::estimation
