#pragma once
/// Standard deviations that add up by their squares.
#include <algorithm>
#include <cmath>

namespace spoolflow::numerics {

/// The root of the sum of squares `whole`, with `from` of it replaced by `to`. Where `from` exceeds `whole`, it is all.
[[nodiscard]] inline double with_instead(double whole, double from, double to) {
  if (from == to) return whole;
  return std::hypot(std::sqrt(std::max(0.0, whole * whole - from * from)), to);
}

}  // namespace spoolflow::numerics
