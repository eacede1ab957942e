#pragma once
/// Whether one flow force at one position means one flow rate, as the paper found for its valve (section 3, Fig 5), and
/// how much flow a newton of force error costs: dQ/dF, the slope of its lines of position.
#include <vector>

#include "spoolflow/calibration/edges/flow_rate_fit.hpp"
#include "spoolflow/model/evidence.hpp"

namespace spoolflow::calibration {

/// Compares neighbouring levels at each position; differences below `force_noise_N` (of an averaged force) show
/// nothing.
[[nodiscard]] model::Uniqueness check_uniqueness(const std::vector<FlowForceColumn>& columns, double force_noise_N);

/// Slopes between pressure differences 5 % apart, from the measured columns. Where the force does not rise the slope
/// has no bound and stands at `cap_m3_per_s_N`.
[[nodiscard]] model::SensitivityMap flow_sensitivity(const std::vector<FlowForceColumn>& columns,
                                                     double cap_m3_per_s_N);

}  // namespace spoolflow::calibration
