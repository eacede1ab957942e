#pragma once
/// Least squares of curves over few knots, of which each sample touches its neighbours alone.
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::plausibility {

struct Weight {
  int unknown;
  double factor;
};

/// Between `count` knots evenly over [0, length], held beyond them: the two that a place lies between.
inline std::array<Weight, 2> between_knots(double place, double length, int count) {
  const double cells = std::clamp(place / length, 0.0, 1.0) * (count - 1);
  const int knot = std::min(static_cast<int>(cells), count - 2);
  const double share = cells - knot;
  return {Weight{knot, 1 - share}, Weight{knot + 1, share}};
}

/// Sums of the normal equations.
class SparseFit {
 public:
  explicit SparseFit(int unknowns)
      : matrix_(Eigen::MatrixXd::Zero(unknowns, unknowns)), right_(Eigen::VectorXd::Zero(unknowns)) {}

  void add(std::span<const Weight> row, double value) {
    for (const Weight& a : row) {
      right_[a.unknown] += a.factor * value;
      for (const Weight& b : row) matrix_(a.unknown, b.unknown) += a.factor * b.factor;
    }
  }

  /// An unknown that no sample determines becomes nearly zero.
  [[nodiscard]] std::vector<double> solve() const {
    constexpr double ridge = 1e-7;
    const double least = ridge * std::max(matrix_.trace() / static_cast<double>(matrix_.rows()), 1e-300);
    Eigen::MatrixXd damped = matrix_;
    damped.diagonal().array() += least;
    const Eigen::VectorXd solution = numerics::solve_symmetric(damped, right_);
    return {solution.begin(), solution.end()};
  }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

/// What a fit makes of a row.
inline double of(std::span<const Weight> row, std::span<const double> solution) {
  double out = 0;
  for (const Weight& weight : row) out += weight.factor * solution[static_cast<std::size_t>(weight.unknown)];
  return out;
}

}  // namespace spoolflow::plausibility
