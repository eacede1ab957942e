#pragma once
/// From a campaign's recordings to a model.
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// Told before each step: what begins, and the share of the whole work done so far, 0 to 1.
using CalibrationProgress = std::function<void(const std::string& step, double share)>;

/// A campaign's recordings, by what was measured.
struct CampaignRecordings {
  const recording::Recording& spring;
  const recording::Recording& solenoid_force_map;
  std::vector<const recording::Recording*> solenoid_dynamic;  ///< none or one
  std::vector<const recording::Recording*> axial_force_maps;  ///< one an oil temperature
  std::vector<const recording::Recording*> operation;         ///< may be none
};

/// All fits in their order: condensed sensor, observer and evidence of the valve's model. Throws CalibrationError.
[[nodiscard]] model::Model calibrate_valve(const CampaignRecordings& recordings, const model::Valve& valve,
                                           const CalibrationProgress& progress);

/// Reads the recordings, fits every part and fills in provenance. Throws RecordingError or CalibrationError, naming the
/// campaign's line where a protocol is missing.
[[nodiscard]] model::Model calibrate(const recording::Campaign& campaign, const std::string& tool_version,
                                     const CalibrationProgress& progress);

}  // namespace spoolflow::calibration
