#include "spoolflow/calibration/operation/identifiable_parameters.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::calibration {
namespace {

/// Largest relative change of the score where the parameter is turned to half or twice its value.
double score_change(const OperationParameter& parameter, const sensor::ObserverParameters<double>& parameters,
                    const std::vector<OperatingRun>& runs, double full_scale_m3_per_s) {
  const double here = *parameter.value;
  const double middle = operation_score(parameters, runs, full_scale_m3_per_s);
  double most = 0;
  for (const double factor : {0.5, 2.0}) {
    *parameter.value = std::clamp(factor * here, parameter.lowest, parameter.highest);
    const double turned = operation_score(parameters, runs, full_scale_m3_per_s);
    most = std::max(most, std::abs(turned - middle) / middle);
  }
  *parameter.value = here;
  return most;
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
  parameters.friction.tolerance_N = unknown_tolerance_N;
  parameters.position_sensor.backlash_m = unknown_backlash_m;
}

std::vector<OperationParameter> identifiable_parameters(sensor::ObserverParameters<double>& parameters,
                                                        const std::vector<OperatingRun>& runs,
                                                        double full_scale_m3_per_s) {
  const bool rests = undithered_rest_s(parameters, runs) >= least_undithered_rest_s;
  std::vector<OperationParameter> out;
  for (const OperationParameter& parameter : operation_parameters(parameters)) {
    const bool identifiable = parameter.shown_by == ShownBy::any_run ||
                              (parameter.shown_by == ShownBy::undithered_rest && rests) ||
                              (parameter.shown_by == ShownBy::score &&
                               score_change(parameter, parameters, runs, full_scale_m3_per_s) >= least_score_share);
    if (identifiable) out.push_back(parameter);
  }
  // The spool's friction on the benches of the other direction may be another share of that in operation.
  const auto other = std::ranges::find_if(runs, [](const OperatingRun& run) { return run.other != nullptr; });
  if (other != runs.end()) {
    out.push_back(
        {"operation_friction_ratio_p_to_a", &other->other->friction.operation_ratio, 0.5, 2.5, ShownBy::any_run});
  }
  return out;
}

}  // namespace spoolflow::calibration
