#pragma once
#include <algorithm>
#include <cmath>
#include <span>

namespace spoolflow::numerics {

/// Of the values that are finite; 0 where none is.
[[nodiscard]] inline double largest_magnitude(std::span<const double> values) {
  double out = 0;
  for (const double value : values) {
    if (std::isfinite(value)) out = std::max(out, std::abs(value));
  }
  return out;
}

}  // namespace spoolflow::numerics
