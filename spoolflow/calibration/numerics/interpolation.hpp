#pragma once
/// Shape-preserving interpolation of measured points onto the sensor's grids.
#include <span>
#include <vector>

namespace spoolflow::calibration {

/// Points of a function of one variable; x rises strictly.
struct Samples1D {
  std::span<const double> x;
  std::span<const double> y;
};

/// A monotone piecewise cubic (PCHIP) through the points, evaluated at `at`; beyond the ends it continues with the
/// value of the end point. With fewer than four points it is linear.
[[nodiscard]] std::vector<double> interpolate_monotone(const Samples1D& points, std::span<const double> at);

/// The least-squares non-decreasing sequence (pool adjacent violators), equal weights.
[[nodiscard]] std::vector<double> non_decreasing(std::span<const double> values);

/// `count` equally spaced numbers from `first` to `last`.
[[nodiscard]] std::vector<double> equally_spaced(double first, double last, int count);

}  // namespace spoolflow::calibration
