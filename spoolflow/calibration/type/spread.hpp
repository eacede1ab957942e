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

/// As wide as a band must be that holds any unit. What a unit deviates by is the same at all of its samples: a band of
/// 1.96 standard deviations leaves 1 unit in 20 outside for good, one of `of_hundred_units` 1 in 100.
[[nodiscard]] KnownDeviations of_any_unit(KnownDeviations known);
inline constexpr double of_hundred_units = 2.576 / 1.960;

/// What is known of units whose sliding friction nobody measured: contacts that age faster stick more while they slide,
/// too.
[[nodiscard]] KnownDeviations sliding_with_ageing(KnownDeviations known,
                                                  const sensor::FrictionParameters<double>& friction);

}  // namespace spoolflow::calibration
