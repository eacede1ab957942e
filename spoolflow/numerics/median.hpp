#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace spoolflow::numerics {

/// The value in the middle, of an even number the larger of the two. NaN values are passed over; NaN where none is
/// left.
[[nodiscard]] inline double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The value below which that share of all lies, of at least one; none is NaN.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace spoolflow::numerics
