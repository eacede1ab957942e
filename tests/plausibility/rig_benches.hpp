#pragma once
/// A valve of the rig, its bench recordings and runs in memory.
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/plausibility/campaign_findings.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {

struct RigBenches {
  double stroke_m = 0, rated_flow_m3_per_s = 0;
  std::map<std::string, recording::Recording> recordings;  ///< by file name

  /// The campaign of these recordings; they must outlive it.
  [[nodiscard]] Benches benches() const {
    Benches out{.rated_flow_m3_per_s = rated_flow_m3_per_s, .stroke_m = stroke_m};
    for (const auto& [file, recording] : recordings) {
      if (file.starts_with("spring")) out.spring = &recording;
      if (file.starts_with("solenoid_map")) out.solenoid_force_map = &recording;
      if (file.starts_with("solenoid_dynamic")) out.solenoid_dynamic = {&recording};
      if (file.starts_with("axial_force_map")) out.axial_force_maps.push_back(&recording);
      if (file.starts_with("ramp")) out.operation.push_back(&recording);
    }
    return out;
  }
  [[nodiscard]] std::vector<const recording::Recording*> all() const {
    std::vector<const recording::Recording*> out;
    for (const auto& [file, recording] : recordings) out.push_back(&recording);
    return out;
  }
};

/// A short campaign: one oil temperature, four pressure differences. Seed 0: as designed; else valve number `seed` of a
/// series with the whole spread of manufacturing.
inline RigBenches measured_benches(const std::string& preset, std::uint64_t seed) {
  rig::ValveAndCampaign asked = rig::read_valve_and_campaign(preset);
  if (seed != 0) {
    asked.valve.seed = seed;
    asked.valve.spread.amount = 1;
  }
  const double top_bar = asked.campaign.pressure_differences_bar.back();
  asked.campaign.oil_temperatures_C = {50};
  asked.campaign.pressure_differences_bar = {0.1 * top_bar, 0.3 * top_bar, 0.6 * top_bar, top_bar};
  const std::vector<rig::CampaignItem> items = rig::calibration_items(asked.valve, asked.campaign);
  RigBenches out{
      asked.valve.plant.spool.stroke_m, units::m3_per_s_from_L_per_min(asked.valve.rating.flow_L_per_min), {}};
  std::mutex storing;
  rig::run_campaign(
      items, {.store = [&](const rig::CampaignItem& item, const rig::BenchRun&, const rig::Simulation& simulation) {
        const std::lock_guard lock(storing);
        recording::Recording& kept = out.recordings[item.file];
        kept = simulation.recording;
        kept.file = item.file;
      }});
  return out;
}

/// The same, measured once for all tests.
inline const RigBenches& rig_benches(const std::string& preset, std::uint64_t seed) {
  static std::map<std::pair<std::string, std::uint64_t>, RigBenches> measured;
  const auto [place, added] = measured.try_emplace({preset, seed});
  if (added) place->second = measured_benches(preset, seed);
  return place->second;
}

}  // namespace spoolflow::plausibility
