#pragma once
/// Which column of a foreign file is which channel, in which unit.
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::recording {

struct TomlTable;

/// One entry of a channel map: value = scale * raw + offset, in `to` if given, else in `unit`.
struct ChannelSource {
  std::string column;  ///< CSV header, MATLAB variable (`struct.field`) or HDF5 path (`rig/time`)
  std::string unit;    ///< unit of the raw value, such as "mA"; empty: taken from the file
  double scale = 1.0;
  double offset = 0.0;
  std::optional<std::string> to = {};  ///< unit of the scaled value where it is another quantity, such as V to mm
};

struct ChannelMap {
  std::map<Channel, ChannelSource> sources;  ///< empty: headers follow <channel>_<unit>
  std::string place;                         ///< where it was written ("map.toml, line 3"), for messages
};

/// Reads a [channels] table (toml_input.hpp). Throws RecordingError with file and line.
[[nodiscard]] ChannelMap read_channels(const TomlTable& table);

/// Reads the [channels] table of a TOML file. Throws RecordingError with file and line.
[[nodiscard]] ChannelMap read_channel_map(const std::filesystem::path& file);

}  // namespace spoolflow::recording
