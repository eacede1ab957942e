#include "spoolflow/calibration/fits/actuator_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "spoolflow/calibration/numerics/nonnegative_least_squares.hpp"
#include "spoolflow/model/describe_observer.hpp"

namespace spoolflow::calibration {

void fit_uncertainty(sensor::ActuatorParameters<double>& actuator, const SolenoidSamples& samples) {
  std::map<int, double> count;
  for (const int test : samples.test) count[test] += 1;
  NormalEquations equations{Eigen::MatrixXd::Zero(3, 3), Eigen::VectorXd::Zero(3)};
  sensor::ActuatorState<double> state;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto estimate = sensor::step(actuator, state, samples.samples[k], samples.restarts[k] != 0);
    const double slope = estimate.force_per_current_N_per_A;
    const double eddy_A = samples.samples[k].current_A - state.coil.static_current_A;
    const double deviation_N = estimate.magnetic_force_N - samples.force_N[k];
    // Deviations beyond this come from steps that the recorder's samples do not resolve.
    const double resolved_N = 0.05 * std::abs(samples.force_N[k]) + slope * actuator.coercive_current_A;
    if (std::abs(deviation_N) > resolved_N + 3 * actuator.force_uncertainty_N) continue;
    const Eigen::Vector3d row(1, slope * slope, slope * slope * eddy_A * eddy_A);
    const double weight = 1 / count[samples.test[k]];
    equations.matrix += weight * row * row.transpose();
    equations.right += weight * deviation_N * deviation_N * row;
  }
  const Eigen::VectorXd parts = solve_nonnegative(equations);
  actuator.force_uncertainty_N = std::hypot(actuator.force_uncertainty_N, std::sqrt(parts(0)));
  actuator.current_uncertainty_A = std::sqrt(parts(1));
  actuator.eddy_uncertainty = std::min(std::sqrt(parts(2)), model::largest_eddy_uncertainty);
}

}  // namespace spoolflow::calibration
