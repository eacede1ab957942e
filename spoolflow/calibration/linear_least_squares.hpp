#pragma once
/// Linear least squares with what it tells of its own unknowns.
#include <vector>

#include <Eigen/Core>

namespace spoolflow::calibration {

/// Rows above each other.
template <class Row>
[[nodiscard]] Eigen::MatrixXd stacked(const std::vector<Row>& rows) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), Eigen::Index{Row::RowsAtCompileTime});
  for (std::size_t r = 0; r < rows.size(); ++r) out.row(static_cast<Eigen::Index>(r)) = rows[r];
  return out;
}

struct LinearLeastSquares {
  Eigen::VectorXd solution;
  Eigen::MatrixXd covariance;  ///< from the residual; zero where nothing is left over to tell it
};

/// How the rows follow each other: measured apart, or samples in a row, whose deviations are alike where neighbours
/// share noise or what the model omits.
enum class Measured { apart, in_a_row };

/// Minimises |matrix * x - right|. Of rows in a row only n (1 - r) / (1 + r) count as independent, with r the
/// deviations' correlation from one to the next (Bayley and Hammersley 1946). JCGM 100, H.3. Throws CalibrationError
/// naming `what` where the rows do not tell the unknowns apart.
[[nodiscard]] LinearLeastSquares least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right,
                                               Measured measured, const char* what);

}  // namespace spoolflow::calibration
