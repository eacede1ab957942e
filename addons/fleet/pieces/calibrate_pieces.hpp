#pragma once
/// `calibrate`: a piece a campaign.
#include <vector>

#include "addons/fleet/jobs/piece.hpp"
#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

/// For Elsewhere::calibrate: all campaigns at once, the models as they come.
void calibrate_by_fleet(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                        const Attempt& attempt);
/// The piece of kind "calibrate".
[[nodiscard]] fleet::Outcome do_calibrate_piece(const fleet::Piece& piece);

}  // namespace spoolflow::apps
