#pragma once
/// What a valve has done: hours, strokes, distance, reversals, loads, energy. Counters of fixed size.
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::monitor {

/// Motion within this share of the stroke is dither motion, no reversal; it is also the least stroke that counts.
inline constexpr double least_stroke_share = 0.02;
/// Motion within this [m] is noise or dither and adds no distance.
inline constexpr double distance_play_m = 5e-6;
/// The load histogram has so many equal classes of flow over rated flow, and as many of pressure difference over the
/// calibrated range; the last holds all beyond.
inline constexpr std::size_t load_classes = 5;

/// While one of these stands, the answer is held or is none of what the valve does: no counter goes on.
inline constexpr sensor::Status uncounted = sensor::Status::position_fault | sensor::Status::sample_missing |
                                            sensor::Status::other_direction | sensor::Status::time_fault |
                                            sensor::Status::coil_fault | sensor::Status::current_fault;

struct Usage {
  std::uint64_t samples = 0;
  double watched_s = 0;       ///< time between samples that were taken, gaps left out
  double driven_s = 0;        ///< of it with coil current
  double distance_m = 0;      ///< travelled by the spool
  double energy_J = 0;        ///< hydraulic, through the metering edge: the integral of flow times pressure difference
  double volume_m3 = 0;       ///< oil through the edge
  std::uint64_t strokes = 0;  ///< motions one way by more than `least_stroke_share`
  std::uint64_t reversals = 0;                               ///< changes of direction between two of them
  std::array<double, load_classes * load_classes> load_s{};  ///< rows: flow; columns: pressure difference

  // The memory of the counters.
  double followed_m = 0;  ///< position within `distance_play_m`
  double extreme_m = 0;   ///< furthest in the direction of motion
  std::int8_t direction = 0;
  bool started = false;
};
static_assert(std::is_trivially_copyable_v<Usage>);

/// One step of the counters.
struct UsageStep {
  double time_step_s;
  double position_m;
  bool driven;
  double flow_m3_per_s;
  double pressure_difference_Pa;
};
struct UsageScale {
  double stroke_m;
  double rated_flow_m3_per_s;
  double highest_pressure_difference_Pa;
};

inline std::size_t load_class(double share) {
  const double place = std::abs(share) * static_cast<double>(load_classes);
  if (!(place < static_cast<double>(load_classes))) return load_classes - 1;
  return static_cast<std::size_t>(place);
}

/// Share of the time in the highest class of pressure difference: what is beyond the calibrated range, and just below.
inline double highest_pressure_share(const Usage& usage) {
  double all_s = 0, highest_s = 0;
  for (std::size_t k = 0; k < usage.load_s.size(); ++k) {
    all_s += usage.load_s[k];
    if (k % load_classes == load_classes - 1) highest_s += usage.load_s[k];
  }
  return all_s > 0 ? highest_s / all_s : 0;
}

/// All numbers finite.
inline void count(Usage& usage, const UsageScale& scale, const UsageStep& step) {
  if (!usage.started) {
    usage.followed_m = usage.extreme_m = step.position_m;
    usage.started = true;
  }
  ++usage.samples;
  usage.watched_s += step.time_step_s;
  if (step.driven) usage.driven_s += step.time_step_s;
  const double volume_m3 = std::abs(step.flow_m3_per_s) * step.time_step_s;
  usage.volume_m3 += volume_m3;
  usage.energy_J += volume_m3 * std::abs(step.pressure_difference_Pa);
  const std::size_t row = load_class(step.flow_m3_per_s / scale.rated_flow_m3_per_s);
  usage.load_s[row * load_classes + load_class(step.pressure_difference_Pa / scale.highest_pressure_difference_Pa)] +=
      step.time_step_s;

  const double beyond_m = step.position_m - usage.followed_m;
  if (std::abs(beyond_m) > distance_play_m) {
    const double moved_m = beyond_m > 0 ? beyond_m - distance_play_m : beyond_m + distance_play_m;
    usage.followed_m += moved_m;
    usage.distance_m += std::abs(moved_m);
  }
  const double least_m = least_stroke_share * scale.stroke_m;
  const double from_m = usage.followed_m - usage.extreme_m;
  if (usage.direction * from_m >= 0 && usage.direction != 0) {
    usage.extreme_m = usage.followed_m;
  } else if (std::abs(from_m) > least_m) {
    if (usage.direction != 0) ++usage.reversals;
    usage.direction = from_m > 0 ? 1 : -1;
    usage.extreme_m = usage.followed_m;
    ++usage.strokes;
  }
}

}  // namespace spoolflow::monitor
