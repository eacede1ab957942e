#pragma once
/// How well a run determines its meter's lag.
#include <optional>
#include <span>

#include "spoolflow/numerics/meter_lag.hpp"

namespace spoolflow::numerics {

/// Half widths of the 95 % intervals of a meter that find_meter_lag() found: of dead time and lag, each > 0, in s. The
/// covariance is that of a fit by the errors' sizes (Powell 1991: curvature from the errors near zero), its scores
/// summed over blocks of a second, so that errors which last count once and not by the sample; two directions that
/// the run cannot distinguish widen both. To it comes what the search and the time step resolve, how early or late the
/// flow may have been estimated, and how far the flow's own errors favour a lag that smooths them; the last two as the
/// rig's runs showed them. A delay of the flow itself beyond that counts as the meter's. Nothing where no lag was found
/// or fewer than ten blocks determine it.
[[nodiscard]] std::optional<MeterLag> meter_lag_uncertainty(std::span<const double> time_s,
                                                            std::span<const double> flow,
                                                            std::span<const double> reference, const MeterLag& found);

}  // namespace spoolflow::numerics
