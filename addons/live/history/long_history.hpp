#pragma once
/// What the store keeps of a valve, thinned to so many points that a page can show days of it.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace spoolflow::live {

/// from_ms <= time < to_ms, since 1970-01-01 UTC; at most so many points, but no more than one a minute of indicators
/// and one a second of flow.
struct Span {
  std::int64_t from_ms, to_ms;
  std::int64_t most_points = 600;
  std::int64_t width_ms =
      0;  ///< of a point; 0: what most_points makes it, which a part of a longer span is not to have
};
inline constexpr std::int64_t least_flow_width_ms = 1000, least_indicator_width_ms = 60'000;
/// Of a point of the span, where its rows are so far apart.
[[nodiscard]] std::int64_t point_width_ms(const Span& span, std::int64_t least_ms);

/// Of one indicator, in its unit. NaN: not known then.
struct IndicatorPoint {
  std::int64_t wall_ms;  ///< mean of the rows that the point is made of
  double value, smallest, largest, uncertainty_95, baseline;
  bool raised;  ///< at least once
};
using IndicatorHistories = std::map<std::string, std::vector<IndicatorPoint>>;
/// By their names. Throws StoreError where the file is no store; empty where it does not know the valve.
[[nodiscard]] IndicatorHistories read_indicators(const std::string& path, const std::string& valve, const Span& span);

struct FlowPoint {
  std::int64_t wall_ms;
  double mean_m3_per_s, smallest_m3_per_s, largest_m3_per_s;
  double lower_m3_per_s, upper_m3_per_s;  ///< outermost ends of the 95 % band
  /// Hydraulic, through the edge, over the time of the samples; a row behind a gap, of steps of more than 10 ms on
  /// average, counts as a second.
  double power_W;
};
[[nodiscard]] std::vector<FlowPoint> read_flow(const std::string& path, const std::string& valve, const Span& span);

}  // namespace spoolflow::live
