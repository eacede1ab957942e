#pragma once
#include <toml++/toml.h>

#include "spoolflow/recording/channel_map.hpp"

namespace spoolflow::recording {

/// A [channels] table inside a TOML file: its own file, or a campaign's [recording.channels].
[[nodiscard]] ChannelMap parse_channel_map(const toml::table& channels, const std::filesystem::path& file);

}  // namespace spoolflow::recording
