#pragma once
/// Descriptions of drawings in the units in which they are drawn: every axis that names a quantity has its unit written
/// out and its values turned into it, every text is written out.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/report/figures/figure.hpp"

namespace spoolflow::report {

/// Turns the values of one axis from SI into the reader's unit; of an axis without a quantity none. Takes the quantity
/// away from the description, so that nothing is turned twice.
class ReaderAxis {
 public:
  ReaderAxis(std::optional<units::Kind>& quantity, const ReaderUnits& units);

  /// With the unit in brackets.
  [[nodiscard]] std::string titled(const std::string& title) const;
  void turn(double& value) const;
  void turn(std::optional<double>& value) const;
  void turn(std::vector<double>& values) const;

 private:
  std::optional<units::Kind> quantity_;
  const ReaderUnits& units_;
};

[[nodiscard]] Figure in_units(Figure figure, const ReaderUnits& units);

}  // namespace spoolflow::report
