#include "spoolflow/calibration/operation/force_error_ratio.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::calibration {

double force_error_ratio(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs) {
  double sum = 0;
  std::size_t samples = 0;
  replay(parameters, runs, [&](const ReplayedSample& sample) {
    const auto& [valve, state, time_s, position_m, reference_m3_per_s, shown] = sample;
    if (state.position.motion != sensor::Motion::rest || sensor::has(state.last.status, sensor::Status::closed)) return;
    const double pressure_Pa = std::max(1e5, state.pressure.pressure_difference_Pa);
    const sensor::EdgePoint<double> edge = valve.edge.at(state.oil.temperature_K, pressure_Pa, position_m);
    const double flow_per_pressure = edge.conductance / (2 * std::sqrt(pressure_Pa));
    const double deviation_m3_per_s =
        flow_per_pressure * sensor::pressure_deviation_Pa(edge, state.force_errors.noise_N);
    const double error =
        (reference_m3_per_s - shown.flow) / std::hypot(deviation_m3_per_s, 2 * parameters.band.flow_residual_m3_per_s);
    sum += error * error;
    ++samples;
  });
  if (samples == 0) return assumed_force_error_ratio;
  return std::max(least_force_error_ratio, std::sqrt(sum / static_cast<double>(samples)));
}

void scale_band(sensor::ObserverParameters<double>& parameters, double force_error_ratio) {
  // One proportion for all valves, found on the runs of five of them together (docs/accuracy.md).
  constexpr double sliding = 1.08;
  constexpr double resting = 1.43;
  constexpr double tolerance = 0.55;
  // The ratio is found at rest, where a larger tolerance of friction than valves have hides errors of forces.
  const double hidden = std::max(1.0, parameters.friction.tolerance_N / largest_usual_tolerance_N);
  parameters.band.force_share = sliding * hidden * force_error_ratio;
  parameters.band.rest_share = resting * hidden * force_error_ratio;
  parameters.band.tolerance_N = tolerance * force_error_ratio * parameters.friction.tolerance_N;
}

}  // namespace spoolflow::calibration
