#pragma once
/// From a campaign's recordings to a model.
#include <functional>
#include <string>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/campaign.hpp"

namespace spoolflow::calibration {

/// Told before each step: what begins, and the share of the whole work done so far, 0 to 1.
using CalibrationProgress = std::function<void(const std::string& step, double share)>;

/// Reads the recordings, fits every part and fills in provenance. Throws RecordingError or CalibrationError, naming the
/// campaign's line where a protocol is missing.
[[nodiscard]] model::Model calibrate(const recording::Campaign& campaign, const std::string& tool_version,
                                     const CalibrationProgress& progress);

}  // namespace spoolflow::calibration
