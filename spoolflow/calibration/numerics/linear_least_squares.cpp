#include "spoolflow/calibration/numerics/linear_least_squares.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {

Eigen::MatrixXd LinearLeastSquares::covariance(double independent) const {
  const Eigen::Index unknowns = solution.size();
  if (deviation.size() <= unknowns) return Eigen::MatrixXd::Zero(unknowns, unknowns);
  return deviation.squaredNorm() / std::max(1.0, independent - static_cast<double>(unknowns)) * inverse;
}

double independent_in_a_row(const Eigen::VectorXd& deviation) {
  const Eigen::Index count = deviation.size();
  const double sum_of_squares = deviation.squaredNorm();
  if (!(sum_of_squares > 0)) return static_cast<double>(count);
  const double alike =
      std::clamp(deviation.head(count - 1).dot(deviation.tail(count - 1)) / sum_of_squares, 0.0, 0.9999);
  return static_cast<double>(count) * (1 - alike) / (1 + alike);
}

LinearLeastSquares least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, const char* what) {
  const Eigen::Index unknowns = matrix.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(unknowns);
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    normal += matrix.row(r).transpose().lazyProduct(matrix.row(r));
    sums += right(r) * matrix.row(r).transpose();
  }
  std::optional<Eigen::MatrixXd> inverse;
  if (matrix.rows() >= unknowns) inverse = numerics::inverse_of_definite(normal);
  if (!inverse) {
    throw CalibrationError(
        fmt::format("{} cannot be identified: {} values do not determine {} unknowns", what, matrix.rows(), unknowns));
  }
  LinearLeastSquares out{inverse->lazyProduct(sums), {}, std::move(*inverse)};
  out.deviation = right - matrix.lazyProduct(out.solution);
  return out;
}

}  // namespace spoolflow::calibration
