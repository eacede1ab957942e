#pragma once
/// A recording in few samples: what checks of forces and flows read, instead of every sample.
#include <cstddef>
#include <span>
#include <vector>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// Means over stretches of equally many samples, at most 2 `most` of them; dither and noise go, slow motion stays.
/// Channels with samples missing in a stretch are NaN there. Channels as name_alike() has them.
[[nodiscard]] recording::Recording block_means(const recording::Recording& recording, std::size_t most);

/// Blocks no shorter than this are compared with forces and the coil [s]: within two periods of dither neither a
/// current that happens to stand still nor a sample's noise counts as the valve's.
inline constexpr double shortest_block_s = 0.025;

/// Of those that are numbers, NaN where they are less than half of all.
[[nodiscard]] double mean_of_numbers(std::span<const double> values);

/// Rows that lie within a stretch of shortest_block_s made one: the means of those that are numbers, NaN where most are
/// none. Rows that stand for longer stay as they are.
[[nodiscard]] recording::Recording longer_blocks(const recording::Recording& means);
/// The same of one column beside its times.
[[nodiscard]] std::vector<double> longer_blocks(std::span<const double> time_s, std::span<const double> values);

/// In place: where upstream and downstream pressure are measured and no difference is, `pressure_difference` is theirs;
/// where only `flow_reference` is, it stands as `flow`.
void name_alike(recording::Recording& means);

/// Of block means: the spool's or armature's velocity [m/s], opening > 0.
[[nodiscard]] std::vector<double> velocities(const recording::Recording& means);

}  // namespace spoolflow::plausibility
