#pragma once
/// Finds break-aways and stretches of even sliding in the stream of samples, in blocks of two milliseconds.
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::monitor {

/// Instants at which friction is known: the spool breaks away after a rest, or slides evenly. There magnetic force less
/// spring force is flow force and friction, paper (1).
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

inline constexpr double event_block_s = 2e-3;
/// The spool has broken away where it stands further from its rest than pre-sliding and noise explain [m].
inline constexpr double breakaway_travel_m = 6e-6;
inline constexpr double breakaway_noises = 8;  ///< and than so many standard deviations of the position's noise
/// A spool that breaks away jumps by this share of it within two blocks. Slower, contacts creep before they slide, and
/// rest on until they have crept so many times as far.
inline constexpr double breakaway_jump_share = 0.5;
inline constexpr double creep_travels = 2.5;
/// Shorter rests [s] are part of a motion; after longer ones nobody knows how far contacts have aged.
inline constexpr double shortest_event_rest_s = 0.03;
inline constexpr double longest_event_rest_s = 1.5;
/// The break-away force is the largest of so many blocks before it.
inline constexpr std::size_t force_blocks = 10;
/// Stretches of sliding end after this share of the stroke, and count from so many blocks on.
inline constexpr double sliding_travel_share = 0.02;
inline constexpr double sliding_blocks = 6;
/// Faster sliding [m/s] has drag and transient flow forces that no map knows.
inline constexpr double fastest_sliding_m_per_s = 3e-3;
/// Near the closed stop and the end stop other forces act: events lie between these shares of the stroke.
inline constexpr double lowest_event_share = 0.03;
inline constexpr double highest_event_share = 0.9;

/// One sample in one direction's signs: opening > 0.
struct FinderSample {
  double time_s;
  double time_step_s;
  double position_m;  ///< free of drift
  double net_force_N;
  double friction_N;
  double current_A;
  double oil_temperature_K;
  double pressure_difference_Pa;
  bool sliding;  ///< the sensor says so
  bool dithered;
};

/// A mean over samples of what an event has.
struct FinderMean {
  double position_m = 0, net_force_N = 0, friction_N = 0, current_A = 0, oil_temperature_K = 0,
         pressure_difference_Pa = 0;
  double weight = 0;
};

struct FinderState {
  FinderMean block;          ///< that grows
  double block_time_s = 0;   ///< its length so far
  double sliding_share = 0;  ///< samples of it in which the spool slides
  double dithered_share = 0;
  std::array<double, force_blocks + 1> force_N{};  ///< of the last blocks, newest at `newest`
  std::array<FinderMean, 3> last{};                ///< the last blocks, newest first
  std::size_t newest = 0;
  std::size_t blocks = 0;  ///< since the rest began, up to the ring's length
  double rest_m = 0;       ///< where the spool rests
  double rest_since_s = 0;
  double still_s = 0;    ///< time of the last block there
  bool resting = false;  ///< the three above are known
  FinderMean slide;      ///< the stretch that grows
  double slide_begin_m = 0;
  double slide_begin_s = 0;
  double slide_dithered = 0;
};
static_assert(std::is_trivially_copyable_v<FinderState>);

/// A fault, a gap or a turn to the other side: nothing is carried over.
void interrupt(FinderState& state);

/// One sample; what it completed. At most one break-away and one stretch of sliding.
struct FoundEvents {
  std::optional<ForceEvent> breakaway;
  std::optional<ForceEvent> slide;
};
[[nodiscard]] FoundEvents find_events(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                      FinderState& state, const FinderSample& sample);

}  // namespace spoolflow::monitor
