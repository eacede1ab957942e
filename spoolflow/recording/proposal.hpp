#pragma once
/// Guesses which foreign column is which channel, from names and units.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/files/file_contents.hpp"

namespace spoolflow::recording {

struct Proposal {
  ChannelMap map;
  /// Columns that could be a channel of the map as well as the one that is proposed, in the file's order.
  std::map<Channel, std::vector<std::string>> as_well{};
  /// Of channels that no column is called by alone, but for the time: the word of the only one whose name holds it
  /// among others, such as "PLC.rPosition".
  std::map<Channel, std::string> by_word{};
  /// Of each column of the file the only channel that words of its name stand for.
  std::vector<std::optional<Channel>> said{};
  /// The pressures of all four ports are named by their port ("pA"). Without one of them, those at P and B are taken
  /// for pressure_upstream and pressure_downstream.
  bool all_ports = false;
};

/// At most one column a channel; columns whose meaning or unit is unknown are left out. Where a column names no
/// unit, `unit` stays empty: it must be filled in by hand.
/// Own names come before known words, words with a unit before words without; "T" is a temperature, "t" a time.
/// Columns of `numberless`, one a column of the file or none at all, are no channel.
[[nodiscard]] Proposal propose_channels(const FileContents& contents, const std::vector<bool>& numberless = {});

/// The map as TOML text, ready to be pasted. `remarks` stand behind their channels; channels of `missing` are lines of
/// comment.
[[nodiscard]] std::string written(const ChannelMap& map, const std::map<Channel, std::string>& remarks = {},
                                  const std::vector<Channel>& missing = {});

}  // namespace spoolflow::recording
