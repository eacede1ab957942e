#include "spoolflow/calibration/linear_least_squares.hpp"

#include <algorithm>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "spoolflow/calibration/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

/// How many independent values the deviations count for.
double independent_count(const Eigen::VectorXd& deviation, Measured measured) {
  const Eigen::Index count = deviation.size();
  const double sum_of_squares = deviation.squaredNorm();
  if (measured == Measured::apart || !(sum_of_squares > 0)) return static_cast<double>(count);
  const double alike =
      std::clamp(deviation.head(count - 1).dot(deviation.tail(count - 1)) / sum_of_squares, 0.0, 0.9999);
  return static_cast<double>(count) * (1 - alike) / (1 + alike);
}

}  // namespace

LinearLeastSquares least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, Measured measured,
                                 const char* what) {
  const Eigen::Index unknowns = matrix.cols();
  const Eigen::RowVectorXd scale = matrix.colwise().norm();
  const auto refuse = [&] {
    throw CalibrationError(
        fmt::format("{} cannot be identified: {} values do not tell {} unknowns apart", what, matrix.rows(), unknowns));
  };
  if (matrix.rows() < unknowns || !(scale.minCoeff() > 0)) refuse();
  const Eigen::MatrixXd scaled = matrix * scale.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(scaled);
  if (solver.rank() < unknowns) refuse();
  LinearLeastSquares out{solver.solve(right).cwiseQuotient(scale.transpose()),
                         Eigen::MatrixXd::Zero(unknowns, unknowns)};
  const Eigen::VectorXd deviation = right - matrix * out.solution;
  if (matrix.rows() == unknowns) return out;
  const double freedom = independent_count(deviation, measured) - static_cast<double>(unknowns);
  const double variance = deviation.squaredNorm() / std::max(1.0, freedom);
  const Eigen::MatrixXd inverse =
      (scaled.transpose() * scaled).ldlt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  out.covariance = variance * (scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal());
  return out;
}

}  // namespace spoolflow::calibration
