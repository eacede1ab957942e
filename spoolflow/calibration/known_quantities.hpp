#pragma once
/// What a campaign measured of a valve's quantities, what it inferred and what it assumes.
#include <vector>

#include "spoolflow/calibration/campaign_recordings.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// One row a quantity, each with its uncertainty where a recording or the campaign's instruments show it. `model` is of
/// one direction, made from `recordings`. "Measured" is what an instrument showed; "inferred" what equations make of
/// other channels; "assumed" what no recording shows. What a fit leaves of its own samples counts twice, as 95 %.
[[nodiscard]] std::vector<model::KnownQuantity> known_quantities(const CampaignRecordings& recordings,
                                                                 const model::Model& model);

}  // namespace spoolflow::calibration
