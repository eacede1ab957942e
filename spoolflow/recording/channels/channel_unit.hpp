#pragma once
/// Which units a channel may be given in, and how they come to the channel's SI unit.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {

/// The unit `written` for this channel, with factor and offset to the channel's own SI unit: with the stroke known,
/// `position` may be in percent and `position_set` in mm. Throws RecordingError, which starts with `place`, names the
/// allowed units, and distinguishes an unknown unit from one of another quantity.
[[nodiscard]] units::Unit channel_unit(Channel channel, std::string_view written, std::optional<double> stroke_m,
                                       const std::string& place);

/// The unit that people have the channel in, and the rig writes it in: "bar", "mm", "percent"; of `test`, which counts,
/// one without a name.
[[nodiscard]] units::Unit usual_unit(Channel channel);

/// The names of the channel's units, the most usual first: "bar", "mbar", "Pa" and so on.
[[nodiscard]] std::vector<std::string> unit_names(Channel channel);

}  // namespace spoolflow::recording
