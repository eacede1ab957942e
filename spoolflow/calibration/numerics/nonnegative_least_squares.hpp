#pragma once
#include <Eigen/Core>

namespace spoolflow::calibration {

/// Normal equations of a linear least-squares problem: `matrix` * x = `right`, symmetric positive semidefinite.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

/// The x >= 0 that minimises the sum of squares, by active sets. Lawson and Hanson, Solving Least Squares Problems
/// (1974), chapter 23.
[[nodiscard]] Eigen::VectorXd solve_nonnegative(const NormalEquations& equations);

}  // namespace spoolflow::calibration
