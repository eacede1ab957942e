#pragma once
/// What `inspect` says of a recording.
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "spoolflow/recording/inspection.hpp"

namespace spoolflow::apps {

struct InspectedFile {
  std::string file;                  ///< as it is reported
  std::string map_file;              ///< of the map that it was read with; empty: none
  const recording::ChannelMap& map;  ///< that map
  const recording::Inspection& found;
};

/// For people.
[[nodiscard]] std::string inspection_text(const InspectedFile& inspected);
/// For programs, `inspect --json`. `protocol`: protocol_json() where it was asked for, else null.
[[nodiscard]] std::string inspection_json(const recording::Inspection& found,
                                          const nlohmann::ordered_json& protocol = {});

}  // namespace spoolflow::apps
