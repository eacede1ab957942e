#pragma once
/// What a run at work shows of two edges that the bench measured together: where flow and pressure difference of the
/// path were recorded, q/(C_joined sqrt(dp)) is C/C_joined of path_of_edges.hpp, and e follows from it.
#include <optional>

#include "spoolflow/calibration/campaign_recordings.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// Operating runs in which the direction opens at positions of that sign: 1 or -1.
struct RunsOfPath {
  Recordings runs;
  double sign;
};

/// e = C2/C1 of a path measured joined, under the load's flows. Needs `pressure_difference` and `flow_reference`:
/// medians over tenths of the stroke from three on, so that the meter's lag and noise count little; their spread and
/// one percent of the meter is what e may be wrong by. Nothing where the runs show less than four tenths, or what no
/// edges can do. Throws CalibrationError.
[[nodiscard]] std::optional<EdgeRatio> edge_ratio_in_operation(const CampaignRecordings& benches,
                                                               const std::vector<RunsOfPath>& operation,
                                                               const model::Valve& valve);

}  // namespace spoolflow::calibration
