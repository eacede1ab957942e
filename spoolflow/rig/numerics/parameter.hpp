#pragma once
/// How the rig's parameter aggregates describe themselves: name, unit, range and reason are written once, beside the
/// member, and scenario files, documents and property tests all visit that description.
///
/// To describe an aggregate, give it
///
///     template <class Self, class Visit>
///     static void describe(Self& self, Visit&& visit) {
///       visit(Parameter{"turns", "1", 100, 3000, "why this range"}, self.turns);   // a number
///       visit("coil", self.coil);                                                   // a nested aggregate
///     }
#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>

namespace spoolflow::rig {

/// One number of the plant: its written name carries the unit; `min` and `max` are both allowed.
struct Parameter {
  std::string_view name;
  std::string_view unit;
  double min;
  double max;
  std::string_view why;
};

/// Calls `visit(path, parameter, value)` for every number below `aggregate`; `path` is dotted, such as
/// "solenoid_b.coil.turns", and valid during the call only. `value` is const when `aggregate` is.
template <class Aggregate, class Visit>
void for_each_parameter(Aggregate& aggregate, Visit&& visit, std::string_view prefix = {}) {
  const auto joined = [&](std::string_view name) {
    return prefix.empty() ? std::string(name) : std::string(prefix).append(".").append(name);
  };
  std::remove_const_t<Aggregate>::describe(aggregate, [&](const auto& what, auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(what)>, Parameter>) {
      visit(std::string_view(joined(what.name)), what, member);
    } else {
      for_each_parameter(member, visit, joined(what));
    }
  });
}

/// Throws std::invalid_argument naming path, value, unit and range when `value` is not finite or outside its range.
void check_range(std::string_view path, const Parameter& parameter, double value);

/// check_range for every number below `aggregate`.
template <class Aggregate>
void check_ranges(const Aggregate& aggregate) {
  for_each_parameter(aggregate, [](std::string_view path, const Parameter& parameter, const double& value) {
    check_range(path, parameter, value);
  });
}

/// Moves every number below `aggregate` into its range.
template <class Aggregate>
void keep_inside_ranges(Aggregate& aggregate) {
  for_each_parameter(aggregate, [](std::string_view, const Parameter& parameter, double& value) {
    value = std::clamp(value, parameter.min, parameter.max);
  });
}

}  // namespace spoolflow::rig
