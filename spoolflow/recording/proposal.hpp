#pragma once
/// Guesses which foreign column is which channel, from names and units.
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// At most one column a channel; columns whose meaning or unit cannot be told are left out. Where a column names no
/// unit, `unit` stays empty: it must be filled in by hand.
[[nodiscard]] ChannelMap propose_channels(const FileContents& contents);

/// The map as TOML text, ready to be pasted.
[[nodiscard]] std::string written(const ChannelMap& map);

}  // namespace spoolflow::recording
