#pragma once
/// What is not known of a unit's deviations makes of its forces and its flow, for the band.
#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::calibration {

/// Standard uncertainties that the deviations leave, root mean squares over the opening and over pressure differences
/// of a tenth of the highest and more.
struct UnitSpread {
  double force_N;          ///< of magnetic force less spring and flow force, in balance
  double friction_share;   ///< of sliding friction
  double flow_share;       ///< of the conductance
  double breakaway_share;  ///< of the force at which the spool breaks away: the most that its ageing time leaves open
};
[[nodiscard]] UnitSpread spread_of(const sensor::ObserverParameters<double>& unit, const KnownDeviations& known);

}  // namespace spoolflow::calibration
