#include "spoolflow/calibration/operation/identifiable_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::calibration {
namespace {

/// Largest relative change of the score where the parameter is turned to half or twice its value.
double score_change(const OperationParameter& parameter, const OperationTrial& here, double full_scale_m3_per_s) {
  constexpr std::array<double, 3> factors{1, 0.5, 2};
  std::array<double, 3> scores{};
  parallel::for_each(factors.size(), parallel::cores(), [&](std::size_t k) {
    OperationTrial trial = here;
    double& value = parameter.in(trial);
    if (factors[k] != 1) value = std::clamp(factors[k] * value, parameter.lowest, parameter.highest);
    scores[k] = operation_score(trial, full_scale_m3_per_s);
  });
  const double middle = scores[0];
  return std::max(std::abs(scores[1] - middle), std::abs(scores[2] - middle)) / middle;
}

}  // namespace

double undithered_rest_s(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs) {
  double sum_s = 0, before_s = INFINITY;
  replay(parameters, runs, [&](const ReplayedSample& sample) {
    const sensor::ObserverState<double>& state = sample.state;
    const bool counts = state.position.motion == sensor::Motion::rest &&
                        !sensor::has(state.last.status, sensor::Status::closed | sensor::Status::dithered);
    if (counts) sum_s += std::max(0.0, sample.time_s - before_s);
    before_s = sample.time_s;
  });
  return sum_s;
}

void assume_rest(sensor::ObserverParameters<double>& parameters) {
  constexpr double unknown_tolerance_N = 1.2;
  constexpr double unknown_backlash_m = 0.55e-6;
  constexpr double unknown_friction_share = 0.15;
  parameters.friction.tolerance_N = unknown_tolerance_N;
  parameters.position_sensor.backlash_m = unknown_backlash_m;
  parameters.band.friction_share = unknown_friction_share;
}

std::vector<OperationParameter> identifiable_parameters(const OperationTrial& trial, double full_scale_m3_per_s) {
  const std::vector<OperatingRun>& runs = trial.runs();
  const bool rests = undithered_rest_s(trial.parameters(), runs) >= least_undithered_rest_s;
  std::vector<OperationParameter> out;
  for (const OperationParameter& parameter : operation_parameters()) {
    const bool identifiable = parameter.shown_by == ShownBy::any_run ||
                              (parameter.shown_by == ShownBy::undithered_rest && rests) ||
                              (parameter.shown_by == ShownBy::score &&
                               score_change(parameter, trial, full_scale_m3_per_s) >= least_score_share);
    if (identifiable) out.push_back(parameter);
  }
  // The spool's friction on the benches of the other direction may be another share of that in operation.
  if (std::ranges::any_of(runs, [](const OperatingRun& run) { return run.other != nullptr; })) {
    out.push_back({"operation_friction_ratio_p_to_a",
                   [](OperationTrial& each) -> double& { return each.other().friction.operation_ratio; }, 0.5, 2.5,
                   ShownBy::any_run});
  }
  return out;
}

}  // namespace spoolflow::calibration
