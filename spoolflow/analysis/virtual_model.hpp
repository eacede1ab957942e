#pragma once
#include <functional>

#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::analysis {

/// The model that calibration makes of a virtual valve's own bench recordings, at four pressure levels. Kept in memory:
/// nothing is written.
[[nodiscard]] model::Model virtual_model(const rig::ValveAndCampaign& asked, unsigned workers,
                                         const std::function<void(double)>& progress);

}  // namespace spoolflow::analysis
