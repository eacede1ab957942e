#pragma once
/// From a campaign's recordings to a model.
#include <cstdint>
#include <functional>
#include <string>

#include "spoolflow/calibration/campaign_recordings.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// Receives before each step what begins, and the share of the whole work done so far, 0 to 1.
using CalibrationProgress = std::function<void(const std::string& step, double share)>;

/// All fits in their order: condensed sensor, observer and evidence of the valve's model. Throws CalibrationError.
[[nodiscard]] model::Model calibrate_valve(CampaignRecordings recordings, const model::Valve& valve,
                                           const CalibrationProgress& progress);

/// The whole valve: each direction from its own benches and operating runs, in its own signs, and both together from
/// runs that go through the centre.
[[nodiscard]] model::Model calibrate_whole_valve(CampaignRecordings p_to_b, CampaignRecordings p_to_a,
                                                 const Recordings& through_centre, const model::Valve& valve,
                                                 const CalibrationProgress& progress);

/// What becomes of recordings that contradict each other or physics (plausibility/campaign_findings.hpp).
enum class Contradictions : std::uint8_t { refused, noted };

/// Reads the recordings, fits every part and fills in provenance: of a whole valve where benches of both directions are
/// named. What is only unusual about the recordings stands among the provenance's doubts, what cannot be as well where
/// it is not refused. Throws RecordingError or CalibrationError, naming the campaign's line where a protocol is
/// missing, and file, channel and likely cause of what cannot be.
[[nodiscard]] model::Model calibrate(const recording::Campaign& campaign, const std::string& tool_version,
                                     const CalibrationProgress& progress,
                                     Contradictions contradictions = Contradictions::refused);

}  // namespace spoolflow::calibration
