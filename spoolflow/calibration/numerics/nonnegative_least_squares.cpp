#include "spoolflow/calibration/numerics/nonnegative_least_squares.hpp"

#include <vector>

#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {
namespace {

/// The unconstrained solution over the free unknowns, zero elsewhere.
Eigen::VectorXd solve_free(const NormalEquations& equations, const std::vector<Eigen::Index>& free) {
  const Eigen::MatrixXd matrix = equations.matrix(free, free);
  const Eigen::VectorXd right = equations.right(free);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(equations.right.size());
  const Eigen::VectorXd solution = numerics::solve_symmetric(matrix, right);
  all(free) = solution;
  return all;
}

}  // namespace

Eigen::VectorXd solve_nonnegative(const NormalEquations& given) {
  // Columns of unit length make one tolerance fit all unknowns.
  const Eigen::Index unknowns = given.right.size();
  const double largest = given.matrix.diagonal().maxCoeff();
  const Eigen::VectorXd scale =
      given.matrix.diagonal().unaryExpr([&](double d) { return d > 1e-14 * largest ? 1 / std::sqrt(d) : 0.0; });
  const NormalEquations equations{scale.asDiagonal() * given.matrix * scale.asDiagonal(),
                                  scale.cwiseProduct(given.right)};
  const double tolerance = 1e-9 * (1e-300 + equations.right.cwiseAbs().maxCoeff());

  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns);
  std::vector<Eigen::Index> free;
  for (Eigen::Index round = 0; round < 6 * unknowns; ++round) {
    const Eigen::VectorXd gradient = equations.right - equations.matrix * x;
    Eigen::Index entering = -1;
    for (Eigen::Index k = 0; k < unknowns; ++k) {
      if (scale(k) == 0 || std::find(free.begin(), free.end(), k) != free.end()) continue;
      if (gradient(k) > tolerance && (entering < 0 || gradient(k) > gradient(entering))) entering = k;
    }
    if (entering < 0) break;
    free.push_back(entering);
    while (!free.empty()) {
      const Eigen::VectorXd trial = solve_free(equations, free);
      double share = 1;
      Eigen::Index leaving = -1;
      for (const Eigen::Index k : free) {
        if (trial(k) > 0) continue;
        const double here = x(k) > trial(k) ? x(k) / (x(k) - trial(k)) : 0.0;
        if (leaving < 0 || here < share) {
          share = here;
          leaving = k;
        }
      }
      if (leaving < 0) {
        x = trial;
        break;
      }
      x += share * (trial - x);
      x(leaving) = 0;
      std::erase(free, leaving);
    }
  }
  return scale.cwiseProduct(x.cwiseMax(0.0));
}

}  // namespace spoolflow::calibration
