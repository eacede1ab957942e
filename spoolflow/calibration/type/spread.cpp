#include "spoolflow/calibration/type/spread.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/type/unit_effects.hpp"

namespace spoolflow::calibration {
namespace {

/// Sum over points of the variance that the deviations leave, each over the square of its scale.
double variance(const Eigen::MatrixXd& slope, const Eigen::VectorXd& scale, const KnownDeviations& known) {
  const Eigen::VectorXd of_each = (slope * known.covariance).cwiseProduct(slope).rowwise().sum();
  return of_each.cwiseQuotient(scale.cwiseProduct(scale)).sum();
}

}  // namespace

UnitSpread spread_of(const sensor::ObserverParameters<double>& unit, const KnownDeviations& known) {
  const EffectSlopes slopes = effect_slopes(unit, operating_points(unit), known.covariance.diagonal().cwiseSqrt());
  const auto points = static_cast<Eigen::Index>(slopes.here.size());
  Eigen::VectorXd friction_N(points), conductance(points);
  for (Eigen::Index p = 0; p < points; ++p) {
    const UnitEffects& here = slopes.here[static_cast<std::size_t>(p)];
    friction_N(p) = std::max(here.friction_N, 1e-6);
    conductance(p) = std::max(here.conductance, 1e-15);
  }
  const auto count = static_cast<double>(points);
  // Of ageing() by the logarithm of its time: the most, after a rest of that time over the root of the ratio.
  const double root = std::sqrt(std::max(1.0, unit.friction.ageing_ratio)), per_time = (root - 1) / (root + 1);
  const auto ageing_time = static_cast<Eigen::Index>(at(Variation::ageing_time));
  return {std::sqrt(variance(slopes.force_N, Eigen::VectorXd::Ones(points), known) / count),
          std::sqrt(variance(slopes.friction_N, friction_N, known) / count),
          std::sqrt(variance(slopes.conductance, conductance, known) / count),
          per_time * std::sqrt(known.covariance(ageing_time, ageing_time))};
}

}  // namespace spoolflow::calibration
