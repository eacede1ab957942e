#include "spoolflow/analysis/virtual_model.hpp"

#include <map>
#include <mutex>
#include <stdexcept>

#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::analysis {
namespace {

using Recordings = std::map<std::string, recording::Recording>;  // by file name

/// Four of the levels, ends included: a study wants the model in seconds.
std::vector<double> four_of(const std::vector<double>& levels) {
  if (levels.size() <= 4) return levels;
  const std::size_t last = levels.size() - 1;
  return {levels[0], levels[last / 3], levels[2 * last / 3], levels[last]};
}

}  // namespace

model::Model virtual_model(const rig::ValveAndCampaign& asked, unsigned workers,
                           const std::function<void(double)>& progress) {
  rig::CampaignSettings campaign = asked.campaign;
  campaign.pressure_differences_bar = four_of(campaign.pressure_differences_bar);
  const std::vector<rig::CampaignItem> items = rig::calibration_items(asked.valve, campaign);
  Recordings recordings;
  std::mutex mutex;  // guards recordings
  constexpr double measuring_share = 0.7;
  rig::run_campaign(items, {.store =
                                [&](const rig::CampaignItem& item, const rig::BenchRun&, const rig::Simulation& run) {
                                  const std::lock_guard lock(mutex);
                                  recordings[item.file] = run.recording;
                                  recordings[item.file].file = item.file;  // for messages
                                },
                            .progress = [&](double share) { progress(measuring_share * share); },
                            .workers = workers});
  std::map<std::string, std::vector<const recording::Recording*>> by_protocol;
  for (const rig::CampaignItem& item : items) by_protocol[item.protocol].push_back(&recordings[item.file]);
  for (const char* protocol : {"spring", "solenoid_force_map", "axial_force_map"}) {
    if (by_protocol[protocol].empty()) throw std::logic_error(std::string("the virtual campaign has no ") + protocol);
  }
  const rig::ValveUnderTest& valve = asked.valve;
  calibration::AxialForceMaps axial_force_maps;
  axial_force_maps.joined = by_protocol["axial_force_map"];
  model::Model out = calibration::calibrate_valve(
      {.spring = *by_protocol["spring"].front(),
       .solenoid_force_map = *by_protocol["solenoid_force_map"].front(),
       .solenoid_dynamic = by_protocol["solenoid_dynamic"],
       .axial_force_maps = axial_force_maps,
       .operation = by_protocol["operation"]},
      {valve.name, units::m3_per_s_from_L_per_min(valve.rating.flow_L_per_min), valve.plant.spool.stroke_m, "b"},
      [&](const std::string&, double share) { progress(measuring_share + (1 - measuring_share) * share); });
  const rig::Oil& oil = valve.plant.oil;
  out.fluid = {valve.fluid, oil.density_15C_kg_per_m3, oil.viscosity_40C_m2_per_s, oil.viscosity_100C_m2_per_s};
  return out;
}

}  // namespace spoolflow::analysis
