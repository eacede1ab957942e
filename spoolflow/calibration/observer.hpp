#pragma once
/// Calibration of the full sensor from a campaign.
#include <functional>
#include <vector>

#include "spoolflow/calibration/campaign_recordings.hpp"
#include "spoolflow/calibration/operation/operation.hpp"
#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

struct ObserverCalibration {
  model::Observer observer;
  model::BenchResiduals bench;
};

/// Position above which the spool counts as on its open stop [m], where the position shows `open_stop_m` there.
[[nodiscard]] double stopped_above_m(double open_stop_m);

/// Bench maps free of position drift; what only operation shows is taken as assumed. `closed_below_m` is the condensed
/// model's. Throws CalibrationError.
[[nodiscard]] ObserverCalibration calibrate_on_bench(const CampaignRecordings& recordings, const model::Valve& valve,
                                                     double closed_below_m);

/// What only operation shows, from runs of which those without a reference flow are left out; what no run shows is
/// assumed, and said so in `defaults`. `progress` receives the share done. Throws CalibrationError.
void calibrate_in_operation(model::Observer& observer, const std::vector<OperatingRun>& runs, const InOperation& valve,
                            const std::function<void(double)>& progress);

/// The other direction of a whole valve takes over what operation showed of the one.
void take_over_operation(const model::Observer& one, model::Observer& other);

}  // namespace spoolflow::calibration
