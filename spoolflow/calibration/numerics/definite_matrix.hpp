#pragma once
#include <optional>

#include <Eigen/Core>

namespace spoolflow::calibration {

/// Inverse of a symmetric positive definite matrix, such as that of normal equations; nothing where a direction is
/// flat, after scaling to a diagonal of ones, to within rounding.
[[nodiscard]] std::optional<Eigen::MatrixXd> inverse_of_definite(const Eigen::MatrixXd& matrix);

/// Precision of a covariance, or the reverse. Throws CalibrationError where a direction is flat.
[[nodiscard]] Eigen::MatrixXd inverse_of_covariance(const Eigen::MatrixXd& matrix);

}  // namespace spoolflow::calibration
