#pragma once
/// What a campaign's recordings say against themselves, each channel by itself, whatever the valve.
#include <vector>

#include "spoolflow/plausibility/finding.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// Frozen channels (frozen_channel.hpp), clipped ones (clipped_channel.hpp), a position that comes late against its
/// current or before it (motion_delay.hpp), one signed current in the columns of both coils (coil_currents.hpp), and
/// oil temperatures that stand still for so long that the campaign's thermometer shows twenty changes elsewhere. A
/// campaign whose oil temperatures are all constant has them typed in, which raises nothing.
[[nodiscard]] std::vector<Finding> channel_findings(const std::vector<const recording::Recording*>& campaign);

}  // namespace spoolflow::plausibility
