#pragma once
/// Beyond which values the indicators of a valve without a baseline of its own count towards an alarm.
#include "spoolflow/monitor/condition.hpp"

namespace spoolflow::monitor {

/// So many spreads of healthy valves are no change: the charts count what lies beyond.
inline constexpr double tolerated_spreads = 1.5;

/// A winding is no warmer than this over calibration, or over what the valve itself showed [K]; with copper's 0.39 %
/// per kelvin (IEC 60028) more resistance is a plug or a strand that fails.
inline constexpr double hottest_over_calibration_K = 100;
inline constexpr double hottest_over_baseline_K = 60;

/// In the indicator's unit; NaN: nothing is judged on that side.
struct AlarmLimits {
  double below, above;
};
/// Of an indicator by its name and what it is compared with. Faults go one way, the position's zero drifts either.
[[nodiscard]] AlarmLimits alarm_limits(const Indicator& indicator);

}  // namespace spoolflow::monitor
