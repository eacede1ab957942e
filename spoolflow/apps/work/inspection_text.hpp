#pragma once
/// What `inspect` says of a recording, `inspect --protocol` of whether it serves a protocol of a campaign, and
/// `inspect FOLDER` of each recording of a folder, and of what is missing for which kind of model.
#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "spoolflow/calibration/campaign_needs.hpp"
#include "spoolflow/calibration/protocol_channels.hpp"
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
/// For programs, `inspect --json`. `fit`: to the protocol that was asked for; null: none was.
[[nodiscard]] std::string inspection_json(const recording::Inspection& found,
                                          const calibration::ProtocolFit* fit = nullptr);

/// Of an inspected file, with the channel map that it was given, else with what of the proposed one has its units.
/// Columns without numbers and with infinite ones do not serve. `file`: named, no pipe. Throws RecordingError.
[[nodiscard]] calibration::ProtocolFit fit_of_inspected(const std::string& file, const recording::ReadOptions& options,
                                                        const recording::Inspection& found,
                                                        recording::Protocol protocol);

/// For people.
[[nodiscard]] std::string protocol_text(const calibration::ProtocolFit& fit);
/// For programs.
[[nodiscard]] nlohmann::ordered_json protocol_json(const calibration::ProtocolFit& fit);

/// One file of the folder.
struct FolderEntry {
  std::string file;
  double seconds = 0;                ///< of the recording
  calibration::Recorded recorded{};  ///< where `why_not` is empty
  std::string why_not{};             ///< of a file that serves no test, with what to do
  bool named_by_campaign = false;    ///< its protocol stands in campaign.toml, else it was recognised
};

/// Of all recordings in the folder, or of those that its campaign.toml names. Reads every one. Throws RecordingError
/// where the campaign cannot be read, std::invalid_argument where there is no recording.
[[nodiscard]] std::vector<FolderEntry> folder_entries(const std::filesystem::path& folder);

/// For people.
[[nodiscard]] std::string folder_text(const std::filesystem::path& folder, const std::vector<FolderEntry>& entries);
/// For programs.
[[nodiscard]] std::string folder_json(const std::vector<FolderEntry>& entries);

}  // namespace spoolflow::apps
