#include "spoolflow/numerics/equations/symmetric_equations.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace spoolflow::numerics {

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Eigen::MatrixXd inverse_of_symmetric(const Eigen::MatrixXd& matrix) {
  return matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

std::optional<Eigen::MatrixXd> inverse_of_definite(const Eigen::MatrixXd& matrix) {
  constexpr double flat = 1e-12;
  if (matrix.size() == 0) return matrix;
  if (!(matrix.diagonal().minCoeff() > 0)) return std::nullopt;
  const Eigen::VectorXd scale = matrix.diagonal().unaryExpr([](double d) { return 1 / std::sqrt(d); });
  const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > flat)) return std::nullopt;
  const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

CommonAxes common_axes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solved(a, b);
  return {solved.eigenvalues(), solved.eigenvectors()};
}

}  // namespace spoolflow::numerics
