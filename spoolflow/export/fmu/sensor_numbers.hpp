#pragma once
/// A sensor's parameters as a row of numbers, in the order in which the model describes them.
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "spoolflow/export/fmu/resource.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/numerics/checksum.hpp"

namespace spoolflow::exports::fmu {

/// The parameters of a whole valve's two directions.
template <class Parameters>
struct BothDirections {
  Parameters b;  ///< flow P to B
  Parameters a;  ///< flow P to A
};

/// Visits a description and hands every number to `each`; the keys go into a checksum, so that two orders differ.
template <class Each>
class NumberVisitor {
 public:
  explicit NumberVisitor(Each each) : each_(each) {}

  template <class Map>
  void map(const model::TableParameter& about, Map& map) {
    named(about.key);
    whole(map.row_axis), whole(map.column_axis);
    for (int row = 0; row < Map::rows; ++row) {
      for (int column = 0; column < Map::columns; ++column) each_(map.node(row, column));
    }
  }
  template <class Curve>
  void curve(const model::TableParameter& about, Curve& curve) {
    named(about.key);
    whole(curve.axis);
    for (auto& value : curve.values) each_(value);
  }
  template <class Volume>
  void volume(const model::TableParameter& about, Volume& volume) {
    named(about.key);
    for (auto& value : volume.values) each_(value);
  }
  template <class Axis>
  void axis(const model::AxisParameter& about, Axis& axis, int /*points*/) {
    named(about.key);
    whole(axis);
  }
  template <class List>
  void list(const model::Parameter& about, List& values) {
    named(about.key);
    for (auto& value : values) each_(value);
  }
  template <class Number>
  void number(const model::Parameter& about, Number& value) {
    named(about.key);
    each_(value);
  }

  [[nodiscard]] std::uint64_t keys() const { return keys_.value(); }

 private:
  template <class Axis>
  void whole(Axis& axis) {
    each_(axis.first), each_(axis.spacing), each_(axis.per_spacing);
  }
  void named(std::string_view key) { keys_.add(key.data(), key.size()); }

  Each each_;
  numerics::Checksum keys_;
};

/// Calls visitor for the parameters of either estimator, of one direction or of both.
template <class Parameters, class Visitor>
void describe(Parameters& parameters, Visitor& visitor) {
  using Of = std::remove_const_t<Parameters>;
  if constexpr (std::is_same_v<Of, sensor::CondensedParameters<double>>) {
    model::describe_condensed(parameters, visitor);
  } else if constexpr (std::is_same_v<Of, sensor::ObserverParameters<double>>) {
    model::describe_observer(parameters, visitor);
  } else {
    describe(parameters.b, visitor);
    describe(parameters.a, visitor);
  }
}

template <class Parameters>
std::vector<double> numbers_of(const Parameters& parameters) {
  std::vector<double> out;
  NumberVisitor visitor([&](const double& value) { out.push_back(value); });
  describe(parameters, visitor);
  return out;
}

/// Name of the order of the numbers: estimator and checksum of its keys.
template <class Parameters>
std::string order_of(std::string_view estimator) {
  NumberVisitor visitor([](const double&) {});
  static const Parameters any{};
  describe(any, visitor);
  return "sensor " + std::string(estimator) + " " + std::to_string(visitor.keys());
}

/// The inverse of numbers_of. Throws ResourceError where there are too few or too many numbers.
template <class Parameters>
void take_numbers(std::span<const double> numbers, Parameters& parameters) {
  std::size_t next = 0;
  NumberVisitor visitor([&](double& value) {
    if (next < numbers.size()) value = numbers[next];
    ++next;
  });
  describe(parameters, visitor);
  if (next != numbers.size()) {
    throw ResourceError("the resource holds " + std::to_string(numbers.size()) + " numbers, the sensor has " +
                        std::to_string(next) + "; export the FMU again with `spoolflow export fmu`");
  }
}

}  // namespace spoolflow::exports::fmu
