#pragma once
/// Calibration of the paper's condensed sensor from the bench recordings of a campaign.
#include "spoolflow/calibration/campaign_recordings.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

struct CondensedCalibration {
  model::Condensed condensed;
  model::Evidence evidence;
};

/// Spring, magnetic-force map, flow-force map, inversion, uniqueness and sensitivity in turn. Of several oil
/// temperatures the middle one is used: the condensed sensor has one map. Throws CalibrationError.
[[nodiscard]] CondensedCalibration calibrate_condensed(const CampaignRecordings& recordings, const model::Valve& valve);

}  // namespace spoolflow::calibration
