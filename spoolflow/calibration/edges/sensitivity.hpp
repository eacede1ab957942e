#pragma once
/// How much flow a newton of force error costs over the map: dQ/dF (paper section 3: the slope of Fig 5's lines of
/// position).
#include <vector>

#include "spoolflow/calibration/edges/flow_rate_fit.hpp"
#include "spoolflow/model/evidence.hpp"

namespace spoolflow::calibration {

/// Slopes between pressure differences 5 % apart, from the measured columns. Where the force does not rise the slope
/// has no bound and stands at `cap_m3_per_s_N`.
[[nodiscard]] model::SensitivityMap flow_sensitivity(const std::vector<FlowForceColumn>& columns,
                                                     double cap_m3_per_s_N);

}  // namespace spoolflow::calibration
