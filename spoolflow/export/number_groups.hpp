#pragma once
/// The sensor's parameters as one row of numbers in the order in which they lie in memory, each group of them with its
/// description from the model's schema. A parameter that is added to the sensor and described there needs nothing here.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/model/parameter.hpp"
#include "spoolflow/numerics/single_precision.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::exports {

/// Numbers that stand together.
struct NumberGroup {
  std::size_t first;  ///< counted from the beginning of the parameters
  std::size_t count;
  std::size_t per_line;
  std::string meaning;
};

using numerics::numbers_of;
using numerics::single_precision;

/// Visitor for model::describe_condensed and describe_observer.
class NumberGroups {
 public:
  /// `parameters`: the object that is visited.
  explicit NumberGroups(const void* parameters) : begin_(static_cast<const char*>(parameters)) {}

  template <int Rows, int Columns>
  void map(const model::TableParameter& about, const sensor::Map<double, Rows, Columns>& map) {
    axis(about.rows, map.row_axis, Rows);
    axis(about.columns, map.column_axis, Columns);
    add(map.values, Columns,
        std::string(about.key) + " over " + about.rows.key + " (a line each) and " + about.columns.key);
  }
  template <int Points>
  void curve(const model::TableParameter& about, const sensor::Curve<double, Points>& curve) {
    axis(about.columns, curve.axis, Points);
    add(curve.values, 12, std::string(about.key) + " over " + about.columns.key);
  }
  template <int Layers, int Rows, int Columns>
  void volume(const model::TableParameter& about, const sensor::Volume<double, Layers, Rows, Columns>& volume) {
    add(volume.values, Columns * Layers,
        std::string(about.key) + ": a line each of " + std::to_string(Rows) + " rows, in it " +
            std::to_string(Columns) + " columns of " + std::to_string(Layers) + " layers, by the axes above");
  }
  void axis(const model::AxisParameter& about, const sensor::Axis<double>& axis, int points) {
    add(axis, 3,
        std::string(about.key) + ": first of " + std::to_string(points) + " grid points, spacing, 1 / spacing");
  }
  template <std::size_t Count>
  void list(const model::Parameter& about, const std::array<double, Count>& values) {
    add(values, 12, about.key);
  }
  void number(const model::Parameter& about, const double& value) { add(value, 1, about.key); }

  template <std::size_t Count>
  void table(const std::string& key, const std::array<double, Count>& numbers, int per_record) {
    add(numbers, static_cast<std::size_t>(per_record), key);
  }

  /// In memory order. Throws std::logic_error where the descriptions leave one of `count` numbers out.
  [[nodiscard]] std::vector<NumberGroup> in_order(std::size_t count) const;

 private:
  template <class Numbers>
  void add(const Numbers& numbers, std::size_t per_line, std::string meaning) {
    constexpr std::size_t bytes = sizeof(double);
    const auto offset = static_cast<std::size_t>(reinterpret_cast<const char*>(&numbers) - begin_);
    groups_.push_back({offset / bytes, sizeof(Numbers) / bytes, per_line, std::move(meaning)});
  }

  const char* begin_;
  std::vector<NumberGroup> groups_;
};

/// The numbers as lines of float literals, each group under a comment with its meaning.
[[nodiscard]] std::string literals(std::span<const double> numbers, std::span<const NumberGroup> groups);

/// One number in single precision as the shortest float literal that is read back as the same float.
[[nodiscard]] std::string float_literal(double number);

}  // namespace spoolflow::exports
