#pragma once
/// Whether one flow force at one position means one flow rate, as the paper found for its valve (section 3, Fig 5).
#include <vector>

#include "spoolflow/calibration/edges/flow_rate_fit.hpp"
#include "spoolflow/model/evidence.hpp"

namespace spoolflow::calibration {

/// Compares neighbouring levels at each position; differences below `force_noise_N` (of an averaged force) show
/// nothing.
[[nodiscard]] model::Uniqueness check_uniqueness(const std::vector<FlowForceColumn>& columns, double force_noise_N);

}  // namespace spoolflow::calibration
