#pragma once
#include <Eigen/Core>

namespace spoolflow::calibration {

/// Precision of a covariance, or the reverse. Throws CalibrationError where a direction is flat.
[[nodiscard]] Eigen::MatrixXd inverse_of_covariance(const Eigen::MatrixXd& matrix);

}  // namespace spoolflow::calibration
