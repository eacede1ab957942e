#pragma once
/// Whether a valve's numbers are such that the sensor's equations can live with them: visitor of a description.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::model {

/// A number that breaks a limit or a relation.
struct Violation {
  std::string path;     ///< below the object that is described, as in a model file: "/spring_force_N/values/3"
  std::string problem;  ///< with the value and what is allowed
};

/// The shortest decimal that means the same number.
template <class T>
std::string decimal(T value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// Parts of a text as one. (GCC 12 warns without reason of what `"/" + text` does inside.)
inline std::string joined(std::initializer_list<std::string_view> parts) {
  std::string out;
  for (const std::string_view part : parts) out.append(part);
  return out;
}

inline std::string allowed(const Limits& limits, std::string_view unit) {
  return joined(
      {decimal(limits.lowest), " to ", decimal(limits.highest), unit == "1" ? "" : " ", unit == "1" ? "" : unit});
}

/// Keeps the first violation. NaN lies outside of all limits.
class LimitCheck {
 public:
  template <class T>
  void number(const Parameter& about, const T& value) {
    within(about, path(about.key), value);
    remember(about, &value, 1);
  }
  template <class T>
  void number(const Parameter& about, const std::optional<T>& value) {
    if (value) number(about, *value);
  }
  template <class T, std::size_t Count>
  void list(const Parameter& about, const std::array<T, Count>& values) {
    for (std::size_t k = 0; k < Count; ++k) {
      within(
          about,
          [&] {
            return joined({"/", about.key, place(k)});
          },
          values[k]);
      if (about.relation.kind == Relation::Kind::rises && k > 0 && !(values[k] > values[k - 1]))
        violated(joined({"/", about.key, place(k)}),
                 joined({decimal(values[k]), " does not rise above ", decimal(values[k - 1]), " before it"}));
    }
    remember(about, values.data(), Count);
  }
  template <class T>
  void axis(const AxisParameter& about, const sensor::Axis<T>& axis, int points) {
    check_axis(about, path(about.key), axis, points);
  }
  template <class T, int Points>
  void curve(const TableParameter& about, const sensor::Curve<T, Points>& curve) {
    check_axis(about.columns, joined({"/", about.key, "/", about.columns.key}), curve.axis, Points);
    for (std::size_t k = 0; k < curve.values.size(); ++k) {
      const auto where = [&] { return joined({"/", about.key, "/values/", std::to_string(k)}); };
      within(about, where, curve.values[k]);
      if (about.relation.kind != Relation::Kind::alike || k == 0) continue;
      const T most = static_cast<T>(about.relation.least);
      if (curve.values[k] > most * curve.values[k - 1] || curve.values[k - 1] > most * curve.values[k])
        violated(where(), joined({decimal(curve.values[k]), " is more than ", decimal(about.relation.least),
                                  " times away from ", decimal(curve.values[k - 1]), " before it"}));
    }
  }
  template <class T, int Rows, int Columns>
  void map(const TableParameter& about, const sensor::Map<T, Rows, Columns>& map) {
    check_axis(about.rows, joined({"/", about.key, "/", about.rows.key}), map.row_axis, Rows);
    check_axis(about.columns, joined({"/", about.key, "/", about.columns.key}), map.column_axis, Columns);
    T largest = 0;
    for (const T value : map.values) largest = std::max({largest, value, -value});
    const T least = static_cast<T>(about.relation.least) * largest;
    for (int row = 0; row < Rows; ++row) {
      for (int column = 0; column < Columns; ++column) {
        const auto where = [&] { return joined({"/", about.key, "/values", place(row), place(column)}); };
        const T value = map.node(row, column);
        within(about, where, value);
        if (about.relation.kind == Relation::Kind::rises_over_rows && row > 0) {
          const T before = map.node(row - 1, column);
          if (!(value - before >= least && value > before))
            violated(where(), joined({decimal(value), " does not rise above ", decimal(before),
                                      " in the row before it by ", decimal(least), " or more"}));
        }
        if (about.relation.kind == Relation::Kind::never_falls && column > 0) {
          const T before = map.node(row, column - 1);
          if (!(value >= before - rounding(before)))
            violated(where(), joined({decimal(value), " falls below ", decimal(before), " before it"}));
        }
      }
    }
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const TableParameter& about, const sensor::Volume<T, Layers, Rows, Columns>& volume) {
    for (int layer = 0; layer < Layers; ++layer)
      for (int row = 0; row < Rows; ++row)
        for (int column = 0; column < Columns; ++column)
          within(
              about,
              [&] {
                return joined({"/", about.key, place(layer), place(row), place(column)});
              },
              volume.node(layer, row, column));
  }

  /// The first violation, relations between different parameters last.
  [[nodiscard]] std::optional<Violation> found() const {
    if (first_) return first_;
    for (const Seen& each : seen_) {
      const Relation& relation = each.about.relation;
      for (const Seen& other : seen_) {
        if (std::string_view(relation.other) != other.about.key) continue;
        for (std::size_t k = 0; k < each.values.size() && k < other.values.size(); ++k) {
          const double value = each.values[k], held = other.values[k];
          const std::string where = joined({"/", each.about.key, each.values.size() > 1 ? place(k) : ""});
          if (relation.kind == Relation::Kind::not_above && !(value <= held))
            return Violation{
                where, joined({decimal(value), " is larger than ", decimal(held), ", which is ", relation.other})};
          if (relation.kind == Relation::Kind::sum_not_negative && !(value + held >= -each.rounding * held))
            return Violation{where, joined({decimal(value), " takes more away than the ", decimal(held), " of ",
                                            relation.other, " at this place"})};
        }
      }
    }
    return std::nullopt;
  }

 private:
  struct Seen {
    Parameter about;
    std::vector<double> values;
    double rounding;  ///< as a share of a value
  };

  static std::string path(const char* key) { return joined({"/", key}); }
  template <class Place>
  static std::string place(Place k) {
    return joined({"/", std::to_string(k)});
  }
  template <class T>
  static T rounding(T value) {
    return (value < 0 ? -value : value) * 64 * std::numeric_limits<T>::epsilon();
  }

  void violated(std::string path, std::string problem) {
    if (!first_) first_ = {std::move(path), std::move(problem)};
  }
  template <class About, class T>
  void within(const About& about, const std::string& path, T value) {
    within(
        about, [&] { return path; }, value);
  }
  /// Limits are meant as they are written, in the precision of the value.
  template <class About, class Path, class T>
  requires std::is_invocable_v<Path>
  void within(const About& about, const Path& path, T value) {
    if (!(value >= static_cast<T>(about.limits.lowest) && value <= static_cast<T>(about.limits.highest)))
      violated(path(), joined({decimal(value), " is outside ", allowed(about.limits, about.unit)}));
  }
  template <class T>
  void remember(const Parameter& about, const T* values, std::size_t count) {
    seen_.push_back({about, {values, values + count}, 64.0 * std::numeric_limits<T>::epsilon()});
  }
  template <class T>
  void check_axis(const AxisParameter& about, const std::string& path, const sensor::Axis<T>& axis, int points) {
    within(about, joined({path, "/0"}), axis.first);
    const std::string end = joined({path, place(points - 1)});
    within(about, end, axis.at(points - 1));
    const T least = static_cast<T>(about.least_step);
    if (!(axis.spacing >= least && axis.per_spacing > 0 && axis.at(points - 1) > axis.first))
      violated(path, joined({"steps of ", decimal(axis.spacing), "; it rises by ", decimal(least), " or more a step"}));
    if (!(axis.at(points - 1) > 0))
      violated(end, joined({decimal(axis.at(points - 1)), " is not above zero, where this axis ends"}));
  }

  std::optional<Violation> first_;
  std::vector<Seen> seen_;
};

/// What `describe(parameters, visitor)` shows first to be wrong.
template <class Parameters, class Describe>
std::optional<Violation> violation(const Parameters& parameters, const Describe& describe) {
  LimitCheck check;
  describe(parameters, check);
  return check.found();
}

}  // namespace spoolflow::model
