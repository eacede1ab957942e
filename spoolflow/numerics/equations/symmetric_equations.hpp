#pragma once
#include <optional>

#include <Eigen/Core>

namespace spoolflow::numerics {

/// x of A x = b for a symmetric A that is positive definite, of which the lower half is read: LDLT with pivots. Here
/// alone it is compiled; each kind of matrix that is factorised elsewhere takes seconds of a build.
[[nodiscard]] Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Inverse of such a matrix, such as the covariance of what normal equations determine.
[[nodiscard]] Eigen::MatrixXd inverse_of_symmetric(const Eigen::MatrixXd& matrix);

/// The same; nothing where a direction is flat, after scaling to a diagonal of ones, to within rounding.
[[nodiscard]] std::optional<Eigen::MatrixXd> inverse_of_definite(const Eigen::MatrixXd& matrix);

/// The axes that two quadratic forms have in common: of A v = lambda B v, both symmetric and B positive definite, each
/// lambda, ascending, and its v as a column, for which v' B v is 1.
struct CommonAxes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
[[nodiscard]] CommonAxes common_axes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace spoolflow::numerics
