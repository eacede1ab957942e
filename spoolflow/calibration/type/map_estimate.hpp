#pragma once

#include <Eigen/Core>

#include "spoolflow/calibration/type/unit_evidence.hpp"

namespace spoolflow::calibration {

inline constexpr auto deviating = static_cast<Eigen::Index>(variations);

/// What the type says of its units before any is measured, or the recordings of one say of it: mean and covariance of
/// the deviations, in the units of all_variations().
struct KnownDeviations {
  Eigen::VectorXd mean;        ///< `variations` entries
  Eigen::MatrixXd covariance;  ///< positive definite
};

/// The type's spread about its mean with these standard deviations, independent.
[[nodiscard]] KnownDeviations spread_of(const Deviations& tolerances);

/// The unit that the recordings make most likely.
struct UnitFit {
  KnownDeviations known;  ///< maximum a posteriori, Laplace's covariance
  double meter_gain;      ///< what the flow meter reads too much, as a share
  Eigen::VectorXd rows;   ///< of the evidence, at that
  double misfit;          ///< robust root mean square of its rows of force and flow, over what was expected; about 1
};

/// Maximum a posteriori by Gauss and Newton with Huber's loss of `huber_deviations` (the rows' errors are not normal),
/// slopes by differences of a tenth of a standard deviation. Steps that do not help are halved.
[[nodiscard]] UnitFit most_likely_unit(const UnitEvidence& evidence, const KnownDeviations& prior);
inline constexpr double huber_deviations = 2;

}  // namespace spoolflow::calibration
