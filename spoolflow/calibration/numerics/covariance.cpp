#include "spoolflow/calibration/numerics/covariance.hpp"

#include <optional>
#include <utility>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {

Eigen::MatrixXd inverse_of_covariance(const Eigen::MatrixXd& matrix) {
  std::optional<Eigen::MatrixXd> inverse = numerics::inverse_of_definite(matrix);
  if (!inverse)
    throw CalibrationError(
        "units have a deviation that neither their tolerances nor their strokes limit; give each of [tolerances] a "
        "value > 0");
  return *std::move(inverse);
}

}  // namespace spoolflow::calibration
