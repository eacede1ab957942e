#pragma once
/// Mean and covariance of what units of a type differ by, from what each one's measurements say.
#include <vector>

#include "spoolflow/calibration/type/map_estimate.hpp"

namespace spoolflow::calibration {

/// What was known of the spread before weighs as much as so many units that were measured.
inline constexpr double tolerances_as_units = 4;

/// What measurements of one unit alone say of its deviations: a normal likelihood, as precision (0 in a direction that
/// they do not show) and precision times mean.
struct UnitLikelihood {
  Eigen::MatrixXd precision;
  Eigen::VectorXd weighted;
};

struct Population {
  KnownDeviations of;                  ///< mean and covariance of the units
  Eigen::MatrixXd open;                ///< covariance of that mean
  std::vector<Eigen::VectorXd> units;  ///< each one's mean
};

/// Empirical Bayes by expectation and maximisation, the covariance with `prior` for prior (inverse Wishart). A middle
/// known before, at zero, weighs as much as `middle_as_units` units: 0 where measurements show each direction well and
/// zero is an arbitrary one of the units. The mean of what no unit shows stays at zero. Two units or more.
[[nodiscard]] Population population_of(const std::vector<UnitLikelihood>& likelihoods, const Eigen::MatrixXd& prior,
                                       double middle_as_units = 0);

}  // namespace spoolflow::calibration
