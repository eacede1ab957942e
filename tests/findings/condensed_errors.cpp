#include "tests/findings/condensed_errors.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/phases.hpp"

namespace spoolflow::findings {
namespace {

constexpr double full_scale_m3_per_s = units::m3_per_s_from_L_per_min(80.0);
constexpr double stroke_m = 2.4e-3;

double error_m3_per_s(const validation::RunSamples& run, std::size_t i) {
  return std::abs(static_cast<double>(run.answers.front().flow_m3_per_s[i]) -
                  static_cast<double>(run.reference_m3_per_s[i]));
}

/// Mean size of the error while moving, at a held pressure difference, over a part of the openings [%FS].
double mean_error_percent(const validation::RunSamples& run, double level_bar, double from_m, double to_m) {
  const validation::Phases phases = validation::phases_of_command(run.time_s, run.position_set);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < run.time_s.size(); ++i) {
    const bool at_level =
        std::abs(units::bar_from_Pa(static_cast<double>(run.pressure_difference_Pa[i])) - level_bar) < 2;
    const bool at_opening = run.position_m[i] >= from_m && run.position_m[i] < to_m;
    if (!phases.moving[i] || phases.reversal[i] || !at_level || !at_opening) continue;
    sum += error_m3_per_s(run, i);
    ++count;
  }
  return 100 * sum / count / full_scale_m3_per_s;
}

/// The error that a share of the chosen samples does not exceed [%FS].
double quantile_percent(const validation::RunSamples& run, const std::vector<bool>& chosen, double share) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i]) errors.push_back(error_m3_per_s(run, i));
  }
  std::sort(errors.begin(), errors.end());
  return 100 * errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))] / full_scale_m3_per_s;
}

}  // namespace

CondensedRuns condensed_runs(const std::filesystem::path& folder) {
  const auto asked = rig::read_valve_and_campaign("size_6");
  std::vector<rig::CampaignItem> items = rig::campaign_items(asked.valve, asked.campaign);
  std::erase_if(items, [](const rig::CampaignItem& item) {
    return item.protocol.empty() && item.file != "ramps_30_to_70bar.csv";
  });
  const auto ramp =
      *std::find_if(items.begin(), items.end(), [](const auto& item) { return item.protocol == "operation"; });
  for (const std::uint64_t seed : {11, 12, 13, 14, 15, 16}) {
    items.push_back(ramp);
    items.back().protocol.clear();  // not for calibration
    items.back().file = fmt::format("ramp_{}.csv", seed);
    items.back().seed = seed;
  }
  rig::run_campaign(items, {.store = [&](const auto& item, const auto& run, const auto& simulation) {
                      std::ofstream file(folder / item.file);
                      rig::write_recording(file, simulation.recording, run);
                      if (!file) throw std::runtime_error("cannot write " + (folder / item.file).string());
                    }});
  std::ofstream(folder / "campaign.toml") << rig::campaign_text(asked.valve, items);
  const recording::Campaign campaign = recording::read_campaign(folder / "campaign.toml");
  const model::Model model = calibration::calibrate(campaign, "rig findings", [](const std::string&, double) {});
  const auto estimated = [&](const std::string& name) {
    return validation::estimate_run(model, folder / name, {}, {estimation::Estimator::condensed}, [](double) {});
  };
  CondensedRuns runs{.ramp = {}, .ramps = estimated("ramps_30_to_70bar.csv")};
  for (const rig::CampaignItem& item : items) {
    if (item.file.starts_with("ramp_")) runs.ramp.push_back(estimated(item.file));
  }
  return runs;
}

std::vector<Finding> condensed_findings(const CondensedRuns& runs) {
  std::vector<double> moving, reversal;
  for (const validation::RunSamples& run : runs.ramp) {
    const validation::Phases phases = validation::phases_of_command(run.time_s, run.position_set);
    moving.push_back(quantile_percent(run, phases.moving, 0.95));
    reversal.push_back(quantile_percent(run, phases.reversal, 1));
  }
  std::vector<Finding> findings{
      {fmt::format("condensed sensor at 60 bar, p95 while moving, median of {} runs", moving.size()),
       numerics::median(moving), "% FS", 8, 14, "paper 4"},
      {fmt::format("condensed sensor at 60 bar, worst around reversal, median of {} runs", reversal.size()),
       numerics::median(reversal), "% FS", 30, 45, "paper 4"}};
  for (const double level_bar : {30.0, 40.0, 50.0, 60.0, 70.0}) {
    const double small = mean_error_percent(runs.ramps, level_bar, 0.15 * stroke_m, 0.45 * stroke_m);
    const double large = mean_error_percent(runs.ramps, level_bar, 0.7 * stroke_m, stroke_m);
    findings.push_back({fmt::format("{:.0f} bar: mean error at large openings over that at small", level_bar),
                        large / small, "", 1.05, 20, "paper 4"});
  }
  return findings;
}

}  // namespace spoolflow::findings
