#pragma once
/// What each fault does to the net force (magnetic less spring force) at one event, by the healthy model.
#include "spoolflow/monitor/event_finder.hpp"
#include "spoolflow/monitor/fault_parameters.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::monitor {

/// Net force [N] of one event about the healthy model at a pressure difference.
struct Explained {
  double residual_N;         ///< measured less explained
  double per_pressure_N_Pa;  ///< slope of what is explained over the pressure difference
  double friction_limit_N;   ///< of spool and armature at that event, >= 0
  double ageing_N;           ///< of it what rest has added to the spool's friction
  double load_slope_N;       ///< change where the whole pressure difference is lost behind the valve, fully open
  double noise_N;            ///< one standard deviation of an event about it, but for what the residual shows
  double current_off_A;      ///< coil current less what the static force map needs without friction
  double half_width_A;       ///< by how much friction and the magnetic loop explain that, >= 0
  Magnitudes slope_N;        ///< over each magnitude, in its units of usual_fault
};

/// Pressure differences are followed beyond the highest calibrated one by the maps' last slopes, up to this multiple.
inline constexpr double extrapolated_share = 1.3;

/// Signatures: friction grows in proportion to its limit; rounded edges turn the jet and so add flow force in
/// proportion to the pressure difference wherever the edge is open (von Mises' jet angle falls by the share that the
/// rounding has in the opening, while the area grows with the opening: their product is constant); springs lose a share
/// of preload or rate; shorted turns lessen the ampere-turns of a current; a shifted position reads all maps elsewhere.
/// Omits what faults do to friction's own slope and to hysteresis.
[[nodiscard]] Explained explain(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                const ForceEvent& event, double pressure_difference_Pa);

}  // namespace spoolflow::monitor
