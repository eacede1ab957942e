#pragma once
/// How an indicator is spread over the valves of a series, and which of them differ from the others.
#include <cstddef>
#include <vector>

namespace spoolflow::fleet {

/// One valve's. NaN where it is not known.
struct ValveFigure {
  double value, uncertainty_95;  ///< half width about it, >= 0
};

/// Median and median absolute deviation (MAD): half of the valves may be anything without moving them far.
struct SeriesSpread {
  double median = 0;
  double scale = 0;  ///< 1.4826 MAD, the standard deviation where the valves are normally distributed; at least what
                     ///< the values themselves are uncertain by (median of uncertainty_95 / 1.96)
  std::size_t valves = 0;  ///< whose value is known
};
[[nodiscard]] SeriesSpread spread_of(const std::vector<ValveFigure>& values);

/// Distance from the median in scales, signed; 0 where the scale is 0, NaN where the value is not known.
[[nodiscard]] double score(const SeriesSpread& spread, const ValveFigure& one);

/// Fewer valves of a series are not compared.
inline constexpr std::size_t fewest_sisters = 5;
/// Iglewicz and Hoaglin, How to Detect and Handle Outliers, 1993: beyond it a value is labelled as an outlier.
inline constexpr double outlier_score = 3.5;
/// Whether the valve differs from the others, and by more than its own value is uncertain.
[[nodiscard]] bool is_outlier(const SeriesSpread& spread, const ValveFigure& one);

}  // namespace spoolflow::fleet
