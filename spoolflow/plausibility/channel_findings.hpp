#pragma once
/// What a campaign's recordings say against themselves, each channel by itself, whatever the valve.
#include <optional>
#include <vector>

#include "spoolflow/plausibility/finding.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// Frozen channels (frozen_channel.hpp), clipped ones (clipped_channel.hpp), a position that comes late against its
/// current or before it (motion_delay.hpp), oil temperatures in another unit (oil_temperature.hpp), one signed current
/// in the columns of both coils (coil_currents.hpp), and oil temperatures that stand still for so long that the
/// campaign's thermometer shows twenty changes elsewhere. A campaign whose oil temperatures are all constant has them
/// typed in, which raises nothing. Two recordings of the same samples: one file twice.
[[nodiscard]] std::vector<Finding> channel_findings(const std::vector<const recording::Recording*>& campaign);

/// The stroke that the campaign states, beside where bench recordings over the whole stroke (`strokes`) end: nothing
/// where they end there, or not all at one place.
[[nodiscard]] std::optional<Finding> stroke_finding(const std::vector<const recording::Recording*>& strokes,
                                                    double stroke_m);

}  // namespace spoolflow::plausibility
