#include "spoolflow/calibration/operation/operation_score.hpp"

#include <algorithm>
#include <limits>

namespace spoolflow::calibration {

OperationTrial::OperationTrial(const sensor::ObserverParameters<double>& parameters,
                               const std::vector<OperatingRun>& runs)
    : directions_{parameters}, runs_(runs) {
  const auto with_other = std::ranges::find_if(runs, [](const OperatingRun& run) { return run.other != nullptr; });
  if (with_other == runs.end()) return;
  directions_.push_back(*with_other->other);
  for (OperatingRun& run : runs_) {
    if (run.other != nullptr) run.other = &directions_.back();
  }
}

std::vector<OperationParameter> operation_parameters() {
  const auto rest = ShownBy::undithered_rest;
  return {
      {"operation_friction_ratio",
       [](OperationTrial& trial) -> double& { return trial.parameters().friction.operation_ratio; }, 0.5, 2.5,
       ShownBy::any_run},
      {"friction_ageing_ratio",
       [](OperationTrial& trial) -> double& { return trial.parameters().friction.ageing_ratio; }, 1.01, 12, rest},
      {"friction_ageing_s", [](OperationTrial& trial) -> double& { return trial.parameters().friction.ageing_s; }, 0.1,
       20, rest},
      {"contact_stiffness_N_per_m",
       [](OperationTrial& trial) -> double& { return trial.parameters().friction.contact_stiffness_N_per_m; }, 5e5, 5e7,
       rest},
      {"friction_tolerance_N", [](OperationTrial& trial) -> double& { return trial.parameters().friction.tolerance_N; },
       0.3, 2.5, rest},
      {"breakaway_share", [](OperationTrial& trial) -> double& { return trial.parameters().friction.breakaway_share; },
       0.05, 0.4, rest},
      {"band_friction_share", [](OperationTrial& trial) -> double& { return trial.parameters().band.friction_share; },
       0.01, 0.2, rest},
      {"position_backlash_m",
       [](OperationTrial& trial) -> double& { return trial.parameters().position_sensor.backlash_m; }, 5e-8, 4e-6,
       rest},
      {"moving_mass_kg", [](OperationTrial& trial) -> double& { return trial.parameters().moving_mass_kg; }, 0.02, 2,
       ShownBy::score},
  };
}

double OperationOutcome::score(double full_scale_m3_per_s) const {
  if (error.samples == 0) return std::numeric_limits<double>::infinity();
  return (interval_score / static_cast<double>(error.samples) + weight_of_error * error.rms()) / full_scale_m3_per_s;
}

std::vector<OperationOutcome> replay_stretches(const sensor::ObserverParameters<double>& parameters,
                                               const std::vector<OperatingRun>& runs, double stretch_s) {
  constexpr double outside_weight = 2 / 0.05;  // of a 95 % interval
  std::vector<OperationOutcome> stretches;
  double ends_s = 0;
  double before_s = std::numeric_limits<double>::infinity();
  replay(parameters, runs, [&](const ReplayedSample& sample) {
    if (sample.time_s < before_s || sample.time_s >= ends_s) {
      stretches.emplace_back();
      ends_s = sample.time_s + stretch_s;
    }
    before_s = sample.time_s;
    OperationOutcome& outcome = stretches.back();
    const auto& [flow, lower, upper] = sample.shown;
    const double reference_m3_per_s = sample.reference_m3_per_s;
    const double outside = std::max({0.0, lower - reference_m3_per_s, reference_m3_per_s - upper});
    outcome.interval_score += upper - lower + outside_weight * outside;
    outcome.error.add(flow - reference_m3_per_s);
    if (outside == 0) ++outcome.inside;
  });
  return stretches;
}

OperationOutcome together(const std::vector<OperationOutcome>& stretches) {
  OperationOutcome out;
  for (const OperationOutcome& each : stretches) {
    out.interval_score += each.interval_score;
    out.inside += each.inside;
    out.error += each.error;
  }
  return out;
}

OperationOutcome replay_whole(const sensor::ObserverParameters<double>& parameters,
                              const std::vector<OperatingRun>& runs) {
  return together(replay_stretches(parameters, runs, std::numeric_limits<double>::infinity()));
}

double operation_score(const OperationTrial& trial, double full_scale_m3_per_s) {
  return replay_whole(trial.parameters(), trial.runs()).score(full_scale_m3_per_s);
}

}  // namespace spoolflow::calibration
