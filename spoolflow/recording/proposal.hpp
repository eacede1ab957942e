#pragma once
/// Guesses which foreign column is which channel, from names and units.
#include <map>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// A column of the file with the last part of its path: "current_A" of "bench/current_A".
[[nodiscard]] FileColumn column_of(const FileContents& contents, std::size_t index);

/// At most one column a channel; columns whose meaning or unit cannot be told are left out. Where a column names no
/// unit, `unit` stays empty: it must be filled in by hand.
/// Own names come before known words, words with a unit before words without; "T" is a temperature, "t" a time.
[[nodiscard]] ChannelMap propose_channels(const FileContents& contents);

/// The map as TOML text, ready to be pasted. `remarks` stand behind their channels; channels of `missing` are lines of
/// comment.
[[nodiscard]] std::string written(const ChannelMap& map, const std::map<Channel, std::string>& remarks = {},
                                  const std::vector<Channel>& missing = {});

}  // namespace spoolflow::recording
