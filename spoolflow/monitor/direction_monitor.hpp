#pragma once
/// One direction of a valve: its events, windows, winding and decisions.
#include <array>

#include "spoolflow/monitor/baseline.hpp"
#include "spoolflow/monitor/cusum.hpp"
#include "spoolflow/monitor/event_finder.hpp"
#include "spoolflow/monitor/event_window.hpp"
#include "spoolflow/monitor/isolation.hpp"
#include "spoolflow/monitor/learnt.hpp"
#include "spoolflow/monitor/trend.hpp"
#include "spoolflow/monitor/winding.hpp"

namespace spoolflow::monitor {

/// One chart a fault and one for what goes against all faults.
inline constexpr std::size_t charts = 7;
inline constexpr std::size_t against_faults = 6;  ///< the last: friction, springs or turns the way that no wear goes
inline constexpr std::size_t zero_below = 5;      ///< the position sensor has two: it drifts either way

/// Scores below this are no change that the charts are to find [standard deviations of a window].
inline constexpr double cusum_allowance = 1.5;
/// Windows that a valve makes in a year of work day and night: one in thirty seconds.
inline constexpr double windows_per_year = 365.25 * 24 * 120;

/// Limits of the charts: half of the false alarms are those of the sum, half those of single scores.
struct Limits {
  double sum;
  double single;
};
[[nodiscard]] Limits limits_for(double false_alarms_per_year);

struct DirectionState {
  FinderState finder;
  WindowState window;
  WindingState winding;
  Learnt learnt;
  std::array<Cusum, charts> chart{};
  Contacts contacts;
  std::array<Course, isolated_faults> course{};  ///< of each fault's first magnitude
  double watched_s = 0;                          ///< time of its samples
  bool resistive = false;                        ///< latched: the coil's resistance is more than warm copper has
  double windows = 0;                            ///< that identified something
  double pressure_Pa = 0;                        ///< of the last window
};
static_assert(std::is_trivially_copyable_v<DirectionState>);

/// What a side is judged against.
struct DirectionReference {
  const sensor::ObserverParameters<double>* valve = nullptr;
  double stroke_m = 0;
  double largest_voltage_V = 0;         ///< more is on no coil, see estimation::CoilLimits
  bool whole = false;                   ///< springs of both ends centre the spool: it rests in the centre, at no stop
  Magnitudes healthy = healthy_spread;  ///< of valves such as it about their models
  DirectionBaseline baseline;
};

/// One sample in the side's own signs.
struct DirectionSample {
  FinderSample motion;
  double voltage_V;  ///< NaN: not measured
  double raw_position_m;
  bool follows;  ///< the sample before it was good, too, and near in time
};
void take(const DirectionReference& reference, const Limits& limits, DirectionState& state,
          const DirectionSample& sample);
/// Nothing is carried over to what comes next.
void leave(DirectionState& state);

/// One sample of a whole valve that follows the one before, in the valve's signs, free of calibrated drift.
struct CentreSample {
  double time_step_s;
  double position_m;
  bool silent;  ///< both coils
};
/// The spool's rest in the centre gives the position sensor's zero; `sides` of solenoids b and a.
void take_centre(const std::array<DirectionReference, 2>& reference, const Limits& limits,
                 std::array<DirectionState, 2>& sides, CentreRest& rest, const CentreSample& sample);
void leave(CentreRest& rest);
/// The window that was begun is judged.
void finish(const DirectionReference& reference, const Limits& limits, DirectionState& state);

/// The first magnitude of each fault, in the order of Fault.
inline constexpr std::array<Magnitude, isolated_faults> first_magnitude{
    Magnitude::friction, Magnitude::edge_rounding, Magnitude::preload_loss, Magnitude::shorted_turns,
    Magnitude::position_zero};

/// What the side has shown, and which faults explain it.
[[nodiscard]] Evidence evidence_of(const DirectionReference& reference, const DirectionState& state);
[[nodiscard]] Isolation isolation_of(const DirectionReference& reference, const DirectionState& state);
[[nodiscard]] bool raised(const DirectionState& state);
/// Something is wrong: a chart is raised, and by what was seen in all a fault, or that the model is wrong, is likely
/// enough. Charts weigh each window by its own noise; what windows share, as how fast the spool moves, does not average
/// out and is weighed here.
[[nodiscard]] bool decided(const DirectionState& state, const Isolation& found);
/// Odds from which a raised chart is reported together with a fault that is not likelier than not.
inline constexpr double least_reported_odds = 0.5;
[[nodiscard]] DirectionBaseline baseline_of(const DirectionReference& reference, const DirectionState& state);

}  // namespace spoolflow::monitor
