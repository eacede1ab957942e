#pragma once
/// A whole campaign of one virtual valve: the bench tests that calibrate it and the operating runs that judge the
/// result, under the file names of a real campaign.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/rig/bench/campaign_items.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::rig {

struct ValveAndCampaign {
  ValveUnderTest valve;
  CampaignSettings campaign;
};
/// `valve` is a valve file, its table [campaign] included, or the name of a preset. Throws SettingsError.
[[nodiscard]] ValveAndCampaign read_valve_and_campaign(const std::string& valve);

/// Bench tests first, then the operating runs.
[[nodiscard]] std::vector<CampaignItem> campaign_items(const ValveUnderTest& valve, const CampaignSettings& settings);
/// Those that campaign.toml lists, and of the operating runs only the one at the ramp pressure.
[[nodiscard]] std::vector<CampaignItem> calibration_items(const ValveUnderTest& valve,
                                                          const CampaignSettings& settings);

/// campaign.toml for those items.
[[nodiscard]] std::string campaign_text(const ValveUnderTest& valve, const std::vector<CampaignItem>& items);

/// Whether a file is such a campaign.toml.
[[nodiscard]] bool is_virtual_campaign(const std::filesystem::path& file);

struct CampaignWork {
  /// Gets each finished recording, from the worker that made it; calls for different items may overlap.
  std::function<void(const CampaignItem&, const BenchRun&, const Simulation&)> store;
  /// Share of the whole, 0 to 1, from one of the workers; calls never overlap.
  std::function<void(double)> progress{};
  unsigned workers = 2;
  bool with_truth = false;
};

/// Simulates every item, the longest first. The recordings do not depend on the number of workers. Rethrows the first
/// exception of a worker once the others have stopped.
void run_campaign(const std::vector<CampaignItem>& items, const CampaignWork& work);

}  // namespace spoolflow::rig
