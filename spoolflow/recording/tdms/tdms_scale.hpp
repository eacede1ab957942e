#pragma once
/// From the numbers that an instrument wrote to those that it measured: the scales that TDMS files keep as properties.
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "spoolflow/recording/tdms/tdms_properties.hpp"

namespace spoolflow::recording {

/// sum of coefficients[k] * raw^k; a linear scale is one of two coefficients.
struct TdmsPolynomial {
  std::vector<double> coefficients;
};
/// Linear between points of rising raw value, beyond the first and the last as these are.
struct TdmsCurve {
  std::vector<std::pair<double, double>> points;
};

/// Scales one after the other; without any the numbers stay as they are.
class TdmsScale {
 public:
  /// Those of the first of channel, group and file that has some. What they are but cannot be used (thermocouples,
  /// strain gauges and other bridges, sums of two scales, or what makes no sense) is reported in `unread`.
  TdmsScale(const TdmsProperties& channel, const TdmsProperties& group, const TdmsProperties& file);

  [[nodiscard]] const std::string& unread() const { return unread_; }
  void apply(double* values, std::size_t count) const;

 private:
  void read(const TdmsProperties& properties);
  [[nodiscard]] std::optional<std::size_t> add(const TdmsProperties& properties, std::size_t index);

  std::vector<std::variant<TdmsPolynomial, TdmsCurve>> steps_;  ///< the first is of the raw number
  std::string unread_;
};

}  // namespace spoolflow::recording
