#pragma once
/// Which channels a protocol's recording is read for, and whether a file has them.
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/recording/read_options.hpp"

namespace spoolflow::calibration {

/// Channels of which one set suffices.
struct Alternative {
  std::vector<std::vector<recording::Channel>> sets;
  std::string_view missing;
};

/// What a protocol's file is read for.
struct ProtocolChannels {
  std::vector<recording::Channel> required, optional;
  std::vector<Alternative> alternatives{};
};
[[nodiscard]] ProtocolChannels channels_of(recording::Protocol protocol);

/// "stroke the spool both ways on the axial-force rig without pressure, with position and axial_force".
[[nodiscard]] std::string_view how_recorded(recording::Protocol protocol);

/// One message for each of the protocol's channels that the table lacks, each with what to do; none: it serves the
/// protocol. `options` has the channel map and the stroke.
[[nodiscard]] std::vector<std::string> missing_channels(const recording::SampleTable& table,
                                                        const recording::ReadOptions& options,
                                                        recording::Protocol protocol, const std::string& file);

struct ProtocolChannel {
  enum class Need : std::uint8_t { needed, one_of, helpful };
  recording::Channel channel;
  Need need;
  std::string column;  ///< empty: the file has none
};

/// What a file is to a protocol.
struct ProtocolFit {
  recording::Protocol protocol;
  std::vector<ProtocolChannel> channels;  ///< all that are read, the needed ones first
  std::vector<std::string> missing;       ///< missing_channels()
};
[[nodiscard]] ProtocolFit fit_for_protocol(const recording::SampleTable& table, const recording::ReadOptions& options,
                                           recording::Protocol protocol, const std::string& file);

}  // namespace spoolflow::calibration
