#include "spoolflow/calibration/type/spread.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/type/unit_effects.hpp"
#include "spoolflow/sensor/band.hpp"

namespace spoolflow::calibration {
namespace {

/// Sum over points of the variance that the deviations leave, each over the square of its scale.
double variance(const Eigen::MatrixXd& slope, const Eigen::VectorXd& scale, const KnownDeviations& known) {
  const Eigen::VectorXd of_each = (slope * known.covariance).cwiseProduct(slope).rowwise().sum();
  return of_each.cwiseQuotient(scale.cwiseProduct(scale)).sum();
}

/// By how much sliding friction falls over the logarithm of the time in which contacts age. A slow spool's are as old
/// as the time in which each is replaced, and give it what a fast one loses.
double ageing_in_sliding(const sensor::FrictionParameters<double>& friction) {
  // Of friction 1 + grows * age over the fresh one, age = t / (ageing time + t).
  constexpr double sliding = 1 / (1 - sensor::most_friction_share_of_speed);
  const double grows = std::max(1.0, friction.ageing_ratio) * sliding - 1, age = (sliding - 1) / grows;
  return grows * age * (1 - age) / sliding;
}

}  // namespace

KnownDeviations of_any_unit(KnownDeviations known) {
  known.covariance *= of_hundred_units * of_hundred_units;
  return known;
}

KnownDeviations sliding_with_ageing(KnownDeviations known, const sensor::FrictionParameters<double>& friction) {
  Eigen::MatrixXd turned = Eigen::MatrixXd::Identity(deviating, deviating);
  for (const Variation part : {Variation::spool_friction, Variation::pressure_friction})
    turned(at(part), at(Variation::ageing_time)) = -ageing_in_sliding(friction);
  known.covariance = turned * known.covariance * turned.transpose();
  return known;
}

UnitSpread spread_of(const sensor::ObserverParameters<double>& unit, const KnownDeviations& known) {
  const EffectSlopes slopes = effect_slopes(unit, operating_points(unit), known.covariance.diagonal().cwiseSqrt());
  const std::size_t points = slopes.here.size();
  Eigen::VectorXd friction_N(points), conductance(points);
  for (std::size_t p = 0; p < points; ++p) {
    friction_N(p) = std::max(slopes.here[p].friction_N, 1e-6);
    conductance(p) = std::max(slopes.here[p].conductance, 1e-15);
  }
  const auto count = static_cast<double>(points);
  // Of ageing() by the logarithm of its time: the most, after a rest of that time over the root of the ratio.
  const double root = std::sqrt(std::max(1.0, unit.friction.ageing_ratio)), per_time = (root - 1) / (root + 1);
  const std::size_t ageing_time = at(Variation::ageing_time);
  return {std::sqrt(variance(slopes.force_N, Eigen::VectorXd::Ones(friction_N.size()), known) / count),
          std::sqrt(variance(slopes.friction_N, friction_N, known) / count),
          std::sqrt(variance(slopes.conductance, conductance, known) / count),
          per_time * std::sqrt(known.covariance(ageing_time, ageing_time))};
}

}  // namespace spoolflow::calibration
