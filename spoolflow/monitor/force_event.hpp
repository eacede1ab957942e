#pragma once
/// Instants at which friction is known: the spool breaks away after a rest, or slides evenly. There magnetic force less
/// spring force is flow force and friction, paper (1).
#include <array>
#include <cstdint>
#include <type_traits>

namespace spoolflow::monitor {

enum class EventKind : std::uint8_t {
  breakaway,  ///< friction at the limit of sticking after that rest
  sliding,    ///< friction of sliding
  dithered,   ///< sliding under dither: friction lessened by its swing, `friction_N` as the sensor estimates
};

struct ForceEvent {
  double time_s;
  double position_m;   ///< free of drift, opening > 0
  double net_force_N;  ///< magnetic force less spring force
  double rested_s;     ///< before a break-away; else 0
  double friction_N;   ///< estimated by the sensor, sign of the motion
  double current_A;
  double oil_temperature_K;
  double pressure_difference_Pa;  ///< estimated by the sensor
  double direction;               ///< 1 opening, -1 closing
  double count;                   ///< events of which this is the mean
  EventKind kind;
};
static_assert(std::is_trivially_copyable_v<ForceEvent>);

}  // namespace spoolflow::monitor
