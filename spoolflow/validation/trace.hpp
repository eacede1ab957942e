#pragma once
/// Long series made short enough to draw, with every peak kept.
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace spoolflow::validation {

/// Breaks a line or an area.
inline constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

/// A line over time; NaN breaks it.
struct Line {
  std::vector<double> time_s;
  std::vector<float> value;
};

/// An area over time; NaN breaks it.
struct Ribbon {
  std::vector<double> time_s;
  std::vector<float> lower, upper;
};

/// The smallest and the largest value of each of `stretches` equal stretches of time, in the order in which they came.
/// Short series stay as they are. Where nothing was recorded for 25 mean steps, and where values are NaN, it breaks.
[[nodiscard]] Line thinned(std::span<const double> time_s, std::span<const float> value, std::size_t stretches);
/// The smallest lower and the largest upper value of each stretch.
[[nodiscard]] Ribbon thinned_band(std::span<const double> time_s, std::span<const float> lower,
                                  std::span<const float> upper, std::size_t stretches);

}  // namespace spoolflow::validation
