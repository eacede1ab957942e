#pragma once
/// A recording in few samples: what checks of forces and flows read, instead of every sample.
#include <cstddef>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::consistency {

/// Means over stretches of equally many samples, at most 2 `most` of them; dither and noise go, slow motion stays.
/// Channels with samples missing in a stretch are NaN there. Channels as name_alike() has them.
[[nodiscard]] recording::Recording block_means(const recording::Recording& recording, std::size_t most);

/// In place: where upstream and downstream pressure are measured and no difference is, `pressure_difference` is theirs;
/// where only `flow_reference` is, it stands as `flow`.
void name_alike(recording::Recording& means);

/// Of block means: the spool's or armature's velocity [m/s], opening > 0.
[[nodiscard]] std::vector<double> velocities(const recording::Recording& means);

}  // namespace spoolflow::consistency
