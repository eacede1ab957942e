#include "spoolflow/calibration/operation/identifiable_dials.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::calibration {
namespace {

/// Largest relative change of the score where the parameter is turned to half or twice its value.
double telling(const Dial& dial, const sensor::ObserverParameters<double>& parameters,
               const std::vector<OperatingRun>& runs, double full_scale_m3_per_s) {
  const double here = *dial.value;
  const double middle = operation_score(parameters, runs, full_scale_m3_per_s);
  double most = 0;
  for (const double factor : {0.5, 2.0}) {
    *dial.value = std::clamp(factor * here, dial.lowest, dial.highest);
    const double turned = operation_score(parameters, runs, full_scale_m3_per_s);
    most = std::max(most, std::abs(turned - middle) / middle);
  }
  *dial.value = here;
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

std::vector<Dial> identifiable_dials(sensor::ObserverParameters<double>& parameters,
                                     const std::vector<OperatingRun>& runs, double full_scale_m3_per_s) {
  const bool rests = undithered_rest_s(parameters, runs) >= least_undithered_rest_s;
  std::vector<Dial> out;
  for (const Dial& dial : operation_dials(parameters)) {
    const bool identifiable = dial.shown_by == ShownBy::any_run ||
                              (dial.shown_by == ShownBy::undithered_rest && rests) ||
                              (dial.shown_by == ShownBy::score &&
                               telling(dial, parameters, runs, full_scale_m3_per_s) >= telling_score_share);
    if (identifiable) out.push_back(dial);
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
