#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::recording {

/// What is read of a file.
struct ReadOptions {
  ChannelMap channels;                          ///< empty: headers follow <channel>_<unit>
  std::vector<Channel> required;                ///< absence of one of these is an error that names it
  std::vector<Channel> optional;                ///< read where present; all other columns are skipped unparsed
  std::optional<double> stroke_m;               ///< lets position be given in percent and position_set in mm
  std::map<Channel, Channel> stands_in = {};    ///< where the first is missing, the second is read as it
  std::map<Channel, std::string> assumed = {};  ///< of an optional one that is missing, what is taken for it (a note)
  /// Of a source that runs on, whose samples are judged one by one: what is no number is missing, lines of another
  /// length are left out, times that are missing or run back are passed on, and nothing is called implausible.
  bool runs_on = false;
  /// An infinite number is a missing sample, where else it is refused (to inspect).
  bool infinite_is_missing = false;
};

}  // namespace spoolflow::recording
