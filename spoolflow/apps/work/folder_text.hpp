#pragma once
/// What `inspect FOLDER` says: what each recording of a folder is, and what is missing for which kind of model.
#include <filesystem>
#include <string>

#include "spoolflow/calibration/campaign_needs.hpp"

namespace spoolflow::apps {

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
