#pragma once
#include <vector>

namespace spoolflow::report {

/// Values in another unit, for drawing.
template <class Number>
[[nodiscard]] std::vector<double> scaled(const std::vector<Number>& values, double factor, double offset = 0) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const Number value : values) out.push_back(static_cast<double>(value) * factor + offset);
  return out;
}

}  // namespace spoolflow::report
