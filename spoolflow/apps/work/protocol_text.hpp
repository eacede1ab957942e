#pragma once
/// What `inspect --protocol` says: whether a recording serves a protocol of a campaign.
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "spoolflow/calibration/protocol_channels.hpp"
#include "spoolflow/recording/inspection.hpp"

namespace spoolflow::apps {

/// Of an inspected file, with the channel map that it was given, else with what of the proposed one has its units.
/// Columns without numbers and with infinite ones do not serve. `file`: named, no pipe. Throws RecordingError.
[[nodiscard]] calibration::ProtocolFit fit_of_inspected(const std::string& file, const recording::ReadOptions& options,
                                                        const recording::Inspection& found,
                                                        recording::Protocol protocol);

/// For people.
[[nodiscard]] std::string protocol_text(const calibration::ProtocolFit& fit);
/// For programs.
[[nodiscard]] nlohmann::ordered_json protocol_json(const calibration::ProtocolFit& fit);

}  // namespace spoolflow::apps
