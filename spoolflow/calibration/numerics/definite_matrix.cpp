#include "spoolflow/calibration/numerics/definite_matrix.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {

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

Eigen::MatrixXd inverse_of_covariance(const Eigen::MatrixXd& matrix) {
  std::optional<Eigen::MatrixXd> inverse = inverse_of_definite(matrix);
  if (!inverse)
    throw CalibrationError(
        "units have a deviation that neither their tolerances nor their strokes limit; give each of [tolerances] a "
        "value > 0");
  return *std::move(inverse);
}

}  // namespace spoolflow::calibration
