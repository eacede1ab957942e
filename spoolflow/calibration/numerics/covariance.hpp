#pragma once
#include <Eigen/Core>

namespace spoolflow::calibration {

/// Precision of a covariance, or the reverse. Throws CalibrationError where a direction is flat.
[[nodiscard]] Eigen::MatrixXd inverse_of_covariance(const Eigen::MatrixXd& matrix);

/// The root of the sum of squares `whole`, with `from` of it replaced by `to`.
[[nodiscard]] double with_instead(double whole, double from, double to);

}  // namespace spoolflow::calibration
