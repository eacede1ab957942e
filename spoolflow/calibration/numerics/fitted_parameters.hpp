#pragma once
/// What a least-squares fit knows of its parameters.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "spoolflow/calibration/numerics/linear_least_squares.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// The covariance of all `unknowns`, of which only the `free` ones were fitted: one that is held, at a bound or by a
/// choice, has variance zero and is correlated with nothing.
[[nodiscard]] inline Eigen::MatrixXd spread_over(Eigen::Index unknowns, const std::vector<Eigen::Index>& free,
                                                 const Eigen::MatrixXd& covariance_of_free) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(unknowns, unknowns);
  out(free, free) = covariance_of_free;
  return out;
}

/// Those unknowns of a non-negative fit that are not held at zero.
[[nodiscard]] inline std::vector<Eigen::Index> above_zero(const Eigen::VectorXd& unknowns) {
  std::vector<Eigen::Index> out;
  for (Eigen::Index k = 0; k < unknowns.size(); ++k)
    if (unknowns(k) > 0) out.push_back(k);
  return out;
}

/// The parameters with their uncertainties and correlations after JCGM 100, 5.2.2 and H.3. `names` with the SI unit as
/// suffix; `covariance` in those units; a parameter of variance zero is correlated with nothing.
[[nodiscard]] inline model::Fit known_from(std::string of, const std::vector<std::string>& names,
                                           const std::vector<double>& values, const Eigen::MatrixXd& covariance) {
  model::Fit fit{std::move(of), {}, {}};
  const auto count = static_cast<Eigen::Index>(names.size());
  for (Eigen::Index r = 0; r < count; ++r) {
    const auto k = static_cast<std::size_t>(r);
    fit.parameters.push_back({names[k], values[k], std::sqrt(std::max(0.0, covariance(r, r)))});
    for (Eigen::Index c = 0; c < count; ++c) {
      const double scale = std::sqrt(std::max(0.0, covariance(r, r) * covariance(c, c)));
      fit.correlation.push_back(r == c ? 1.0 : scale > 0 ? std::clamp(covariance(r, c) / scale, -1.0, 1.0) : 0.0);
    }
  }
  return fit;
}

/// The same of a linear fit whose rows were measured apart, or of samples in a row.
[[nodiscard]] inline model::Fit known_from_apart(std::string of, const std::vector<std::string>& names,
                                                 const LinearLeastSquares& fit) {
  return known_from(std::move(of), names, {fit.solution.begin(), fit.solution.end()}, fit.covariance());
}
[[nodiscard]] inline model::Fit known_from_samples(std::string of, const std::vector<std::string>& names,
                                                   const LinearLeastSquares& fit) {
  return known_from(std::move(of), names, {fit.solution.begin(), fit.solution.end()},
                    fit.covariance(independent_in_a_row(fit.deviation)));
}

}  // namespace spoolflow::calibration
