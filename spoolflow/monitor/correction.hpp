#pragma once
/// A model of a valve that has changed: what more friction, weaker springs, shorted turns and a shifted position sensor
/// make of the healthy parameters. Each follows from the maps themselves; nothing is fitted.
#include "spoolflow/monitor/fault_parameters.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::monitor {

/// How a valve differs from its model. {} is no difference.
struct Difference {
  double friction_ratio = 1;   ///< friction over the model's, of spool and armature alike
  double preload_loss = 0;     ///< share of the springs' force at the closed stop
  double rate_loss = 0;        ///< share of their rate between closed stop and end stop
  double shorted_turns = 0;    ///< share of the winding's turns, 0 to below 1
  double position_zero_m = 0;  ///< the position sensor reads so much too much
};

/// Where the closed spool stands by the sensor's signal [m]: at zero, until a correction has moved it.
template <class T>
[[nodiscard]] constexpr T closed_stop_m(const sensor::ObserverParameters<T>& valve) {
  return valve.edge.position_m.first;
}

/// Friction: both its maps, and what pre-sliding may be wrong by, in proportion. Springs: a constant and a part in
/// proportion to the way from the closed stop. Turns, n the share that is left: a current makes n times the
/// ampere-turns, so that force, flux linkage, hysteresis and eddy currents are those of n times the current, with n
/// times the flux linkage of each flux; what is shorted is a further eddy current, s/(n^2 R) amperes per volt of flux
/// rate (rig/plant/solenoid.hpp has the same circuit); the resistance falls to n. Position zero: all maps' positions
/// move by it. Omits what wear does to ageing at rest and to the contacts' stiffness.
void apply(const Difference& difference, double stroke_m, sensor::ObserverParameters<double>& valve);

/// The same of the condensed sensor's averaged maps. Their axes begin at zero: a shift is interpolated.
void apply(const Difference& difference, double stroke_m, sensor::CondensedParameters<double>& valve);

}  // namespace spoolflow::monitor
