#pragma once
/// Linear least squares with the uncertainty of its unknowns.
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
  Eigen::VectorXd deviation;  ///< of the right side from the matrix times the solution
  Eigen::MatrixXd inverse;    ///< of the normal equations' matrix

  /// Of the solution, if so many of the deviations are independent. JCGM 100, H.3. Zero where there are no more rows
  /// than unknowns, so that no residual determines it.
  [[nodiscard]] Eigen::MatrixXd covariance(double independent) const;
  /// The same of rows that were measured apart from each other.
  [[nodiscard]] Eigen::MatrixXd covariance() const { return covariance(static_cast<double>(deviation.size())); }
};

/// Of samples in a row, whose deviations are alike where neighbours share noise or what the model omits, only
/// n (1 - r) / (1 + r) count as independent, r their correlation from one to the next (Bayley and Hammersley 1946).
[[nodiscard]] double independent_in_a_row(const Eigen::VectorXd& deviation);

/// Minimises |matrix * x - right|. Throws CalibrationError naming `what` where the rows do not distinguish the
/// unknowns.
[[nodiscard]] LinearLeastSquares least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right,
                                               const char* what);

}  // namespace spoolflow::calibration
