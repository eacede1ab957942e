/// What two recordings say of a unit, against Gauss's law of errors worked out by hand.
#include "spoolflow/calibration/type/unit_agreement.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

/// Units lie one standard deviation of 1 apart in each direction.
KnownDeviations any_unit() {
  return {Eigen::VectorXd::Zero(deviating), Eigen::MatrixXd::Identity(deviating, deviating)};
}

/// What is known of a unit of which one direction was measured, with an error of this variance.
KnownDeviations measured(Eigen::Index direction, double value, double variance) {
  KnownDeviations out = any_unit();
  out.mean(direction) = value / (1 + variance);
  out.covariance(direction, direction) = variance / (1 + variance);
  return out;
}

TEST(UnitAgreement, CountsTheErrorsOfBothMeasurementsOfAUnit) {
  const Disagreement found = disagreement_of(measured(3, 0.3, 0.02), measured(3, -0.1, 0.02), any_unit());
  const double deviations = 0.4 / std::sqrt(0.02 + 0.02);
  EXPECT_NEAR(found.chi_square, deviations * deviations, 0.02);
  EXPECT_EQ(found.variation, 3U);
  EXPECT_NEAR(found.one, 0.3 / 1.02, 1e-12);
  EXPECT_NEAR(found.other, -0.1 / 1.02, 1e-12);
}

TEST(UnitAgreement, IsNotDeniedByARecordingThatDoesNotShowTheDirection) {
  const Disagreement found = disagreement_of(measured(3, 2, 0.01), measured(5, -1, 0.01), any_unit());
  EXPECT_NEAR(found.chi_square, (2.0 * 2 + 1) / 1.01, 0.01) << "no more than the unit's distance from its type";
}

TEST(UnitAgreement, TakesWhatTheTypesMapsAreWrongByForTheSameInAllRowsOfALongerRun) {
  EXPECT_DOUBLE_EQ(disagreeing_chi_square_of(100, 400), disagreeing_chi_square);
  EXPECT_DOUBLE_EQ(disagreeing_chi_square_of(1350, 100), 3 * disagreeing_chi_square);
  EXPECT_DOUBLE_EQ(disagreeing_chi_square_of(100, 1350), disagreeing_chi_square_of(1350, 100));
}

}  // namespace
}  // namespace spoolflow::calibration
