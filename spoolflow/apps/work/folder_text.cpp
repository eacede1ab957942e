#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/work/harmless_text.hpp"
#include "spoolflow/apps/work/inspection_text.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/protocol_channels.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;

/// Files of that name are no recordings.
bool may_be_recording(const fs::path& file) {
  static const std::vector<std::string> kinds{".csv", ".mat", ".h5",  ".hdf5",    ".tdms",
                                              ".mf4", ".mdf", ".txt", ".parquet", ".xlsx"};
  return std::ranges::count(kinds, file.extension().string()) > 0;
}

/// With what the protocol is read; without one with every channel.
recording::ReadOptions options_for(const recording::CampaignRecording* named, const recording::Campaign* campaign) {
  recording::ReadOptions out;
  if (named != nullptr) out.channels = named->channels;
  if (campaign != nullptr) out.stroke_m = campaign->valve.stroke_m;
  return out;
}

FolderEntry entry_of(const fs::path& file, const recording::CampaignRecording* named,
                     const recording::Campaign* campaign) {
  FolderEntry out{.file = file.filename().string(), .named_by_campaign = named != nullptr};
  try {
    const recording::Recording read = recording::read_recording(file, options_for(named, campaign));
    if (read.size() > 1) {
      const auto time_s = read[recording::Channel::time];
      out.seconds = time_s.back() - time_s.front();
    }
    out.recorded = named != nullptr ? calibration::recorded_by(read, named->protocol) : calibration::recognised(read);
    if (named != nullptr) out.recorded.direction = named->direction;
  } catch (const recording::RecordingError& error) {
    out.why_not = error.what();
  } catch (const calibration::CalibrationError& error) {
    out.why_not = error.what();
  }
  return out;
}

std::string minutes(double seconds) {
  return fmt::format("{:.1f} min", seconds / 60);
}

std::string about(const calibration::Recorded& recorded) {
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (!std::isnan(recorded.oil_temperature_K))
    add(fmt::format("{:.0f} degC", units::degC_from_K(recorded.oil_temperature_K)));
  if (recorded.levels > 0) add(fmt::format("slow strokes at {} pressure differences", recorded.levels));
  if (recording::by_own_solenoid(recorded.protocol) && !recorded.voltage) add("no voltage");
  return out;
}

std::vector<calibration::ModelNeeds> needs_of(const std::vector<FolderEntry>& entries) {
  std::vector<calibration::Recorded> recorded;
  for (const FolderEntry& entry : entries) {
    if (entry.why_not.empty()) recorded.push_back(entry.recorded);
  }
  return calibration::needs_of(recorded);
}

std::string listed(const std::vector<calibration::NeededRecording>& all) {
  std::string out;
  for (const calibration::NeededRecording& each : all) {
    out += fmt::format("  {} (direction {}), {:g} min: {}\n      {}\n", recording::name(each.protocol), each.direction,
                       each.minutes, each.why, calibration::how_recorded(each.protocol));
  }
  return out;
}

using Json = nlohmann::ordered_json;

Json json_of(const std::vector<calibration::NeededRecording>& all) {
  Json out = Json::array();
  for (const calibration::NeededRecording& each : all) {
    out.push_back({{"protocol", recording::name(each.protocol)},
                   {"direction", each.direction},
                   {"minutes", each.minutes},
                   {"why", each.why}});
  }
  return out;
}

}  // namespace

std::vector<FolderEntry> folder_entries(const fs::path& folder) {
  std::vector<FolderEntry> out;
  std::optional<recording::Campaign> campaign;
  if (fs::exists(folder / "campaign.toml")) {
    campaign = recording::read_campaign(folder / "campaign.toml");
    for (const recording::CampaignRecording& named : campaign->recordings)
      out.push_back(entry_of(named.file, &named, &*campaign));
    return out;
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& each : fs::directory_iterator(folder)) {
    const bool leads_nowhere = each.is_symlink() && !fs::exists(each.path());  // as where a drive is missing
    if ((each.is_regular_file() || leads_nowhere) && may_be_recording(each.path())) files.push_back(each.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) out.push_back(entry_of(file, nullptr, nullptr));
  if (out.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: holds no recording and no campaign.toml; give the folder of a valve's recordings (CSV, "
                    "MATLAB, HDF5, TDMS, MDF 4)",
                    folder.string()));
  }
  return out;
}

std::string folder_text(const fs::path& folder, const std::vector<FolderEntry>& entries) {
  std::string out = fmt::format("{}: {} recording{}\n\n{:<32} {:<22} {:>9}\n", terminal_text(folder.string()),
                                entries.size(), entries.size() == 1 ? "" : "s", "file", "protocol", "length");
  for (const FolderEntry& entry : entries) {
    if (!entry.why_not.empty()) {
      out += fmt::format("{:<32} serves no test: {}\n", terminal_text(entry.file), terminal_text(entry.why_not));
      continue;
    }
    out += fmt::format("{:<32} {:<22} {:>9}  {}\n", terminal_text(entry.file), recording::name(entry.recorded.protocol),
                       minutes(entry.seconds), about(entry.recorded));
  }
  if (std::ranges::none_of(entries, &FolderEntry::named_by_campaign))
    out += "The protocols were recognised by channels and course: state them in campaign.toml.\n";
  for (const calibration::ModelNeeds& kind : needs_of(entries)) {
    out += fmt::format("\nModel from {}: ", kind.kind);
    out += kind.missing.empty() ? "everything needed is there\n"
                                : fmt::format("missing, {:g} min on the bench:\n", kind.missing_minutes());
    out += listed(kind.missing);
    if (!kind.better.empty()) out += " better with:\n" + listed(kind.better);
  }
  return out;
}

std::string folder_json(const std::vector<FolderEntry>& entries) {
  Json recordings = Json::array(), models = Json::array();
  for (const FolderEntry& entry : entries) {
    Json& each = recordings.emplace_back(Json{{"file", entry.file}});
    if (entry.why_not.empty()) {
      each.update({{"protocol", recording::name(entry.recorded.protocol)},
                   {"direction", entry.recorded.direction},
                   {"seconds", entry.seconds},
                   {"levels", entry.recorded.levels}});
    } else {
      each["why_not"] = entry.why_not;
    }
  }
  for (const calibration::ModelNeeds& kind : needs_of(entries)) {
    models.push_back({{"kind", kind.kind},
                      {"complete", kind.missing.empty()},
                      {"missing", json_of(kind.missing)},
                      {"better", json_of(kind.better)}});
  }
  return json_text(Json{{"recordings", recordings}, {"models", models}});
}

}  // namespace spoolflow::apps
