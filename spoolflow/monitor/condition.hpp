#pragma once
/// A valve's condition: indicators, what explains them, and the sign of NAMUR NE 107.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace spoolflow::monitor {

/// Signs of NAMUR NE 107 (2012-04), ascending: a worse one hides those before it.
enum class Ne107 : std::uint8_t {
  good,
  maintenance_required,  ///< M: the answer holds, the valve wears
  out_of_specification,  ///< S: the valve is used beyond what was calibrated, or the answer's band no longer holds
  function_check,        ///< C: no answer for a while, as the inputs are missing
  failure,               ///< F: an input or the coil has failed
};
/// "good", "M", "S", "C" or "F".
[[nodiscard]] std::string_view name(Ne107 sign);

/// Faults that are distinguished. `wrong_model`: no single one explains what is seen.
enum class Fault : std::uint8_t { friction, edge_wear, spring, coil, position_sensor, temperature_sensor, wrong_model };
inline constexpr std::size_t faults = 7;
/// "friction", "edge_wear", "spring", "coil", "position_sensor", "temperature_sensor", "wrong_model".
[[nodiscard]] std::string_view name(Fault fault);
/// That the fault makes as a cause: M or S.
[[nodiscard]] Ne107 sign_of(Fault fault);

/// One explanation of raised indicators.
struct Cause {
  Fault fault;
  double odds;  ///< that it is there, to one that it is not; > 0, at most 1e6
};

/// Of one indicator.
enum class IndicatorState : std::uint8_t {
  unknown,   ///< nothing was learnt yet: its conditions were not met
  learning,  ///< too little was learnt for a judgement
  good,
  raised,  ///< latched: beyond its limit by the decision of its CUSUM
  counts,  ///< a counter, which is not judged
};
/// "unknown", "learning", "good", "raised", "counts".
[[nodiscard]] std::string_view name(IndicatorState state);

/// Trend of an indicator, given only where its slope is beyond chance (trend.hpp).
struct Trend {
  bool there = false;
  double per_hour = 0;        ///< of watched time, in the indicator's unit
  double uncertainty_95 = 0;  ///< half width about it
  double limit = 0;           ///< twice the usual fault (fault_parameters.hpp), in the indicator's unit
  /// Watched time until it is reached [h]; the first and the last with 95 %. Infinite: perhaps never.
  double earliest_h = 0, expected_h = 0, latest_h = 0;
};

/// A figure of a valve's condition. NaN where it is not known.
struct Indicator {
  std::string_view name;  ///< in snake case, with no unit; static storage
  double value;           ///< of the last strokes or windows
  std::string_view unit;  ///< SI or as named; "1" for shares and ratios
  double uncertainty_95;  ///< half width about `value`, >= 0
  double baseline;        ///< what it is compared with: learnt, or the model's
  IndicatorState state;
  Trend trend = {};
  double spread = 0;  ///< one standard deviation of healthy valves about `baseline`, >= 0; 0: not judged by it
};

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
/// Of an indicator by its name, what it is compared with and how healthy valves spread. Faults go one way, the
/// position's zero drifts either.
[[nodiscard]] AlarmLimits alarm_limits(const Indicator& indicator);

}  // namespace spoolflow::monitor
