#pragma once
/// Which column of an open file is which channel, and how its numbers come to SI.
#include <cstddef>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/recording/read_options.hpp"

namespace spoolflow::recording {

/// value in SI = gain * raw + offset.
struct BoundColumn {
  std::size_t column;  ///< index in the file
  Channel channel;
  double gain;
  double offset;
  std::string name;  ///< the column's name in the file, for messages
  units::Unit unit;  ///< the unit that the values were said to be in
};

/// The columns of all required channels, and of the optional ones where the file has them; of every channel where
/// neither is named. `time` is always required.
/// A channel that the map names is taken from there; any other from a header <channel>_<unit>. Throws RecordingError: a
/// required channel that is missing, a column that the map names and the file lacks, two columns for one channel, a
/// unit that is unknown, missing, of another quantity, or at odds with the one the file states.
/// Where the file holds several times, that of the leading channel is taken; where it has none but the leading channel
/// is sampled evenly (FileColumn), `time` is bound to a column beyond the last, which on_one_clock() provides.
[[nodiscard]] std::vector<BoundColumn> bind_channels(const SampleTable& table, const ReadOptions& options,
                                                     const std::string& file);

/// Of the channels that were asked for where they can be had and are not bound: what would be one by its name, but
/// cannot be read, and what may be one by another name (proposal.hpp), with its remedy, and what is assumed for the
/// channel. Empty: nothing.
[[nodiscard]] std::string unread_channels(const SampleTable& table, const ReadOptions& options,
                                          const std::vector<BoundColumn>& bound, const std::string& file);

/// Of the bound channels the one whose time is that of the recording: the current, else the position, else the first
/// that is not time. Null where there is none.
[[nodiscard]] const BoundColumn* leading_channel(const std::vector<BoundColumn>& bound);

}  // namespace spoolflow::recording
