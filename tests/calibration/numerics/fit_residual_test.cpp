#include "spoolflow/calibration/numerics/fit_residual.hpp"

#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/fitted_parameters.hpp"

namespace spoolflow::calibration {
namespace {

TEST(FitResidual, OfPartsIsThatOfTheWhole) {
  FitResidual whole, first, second;
  for (const double deviation : {1.0, -3.0, std::nan(""), 2.0, -0.5}) {
    whole.add(deviation);
    (whole.samples < 3 ? first : second).add(deviation);
  }
  first += second;
  EXPECT_EQ(first.samples, 4U);
  EXPECT_EQ(first.largest, 3);
  EXPECT_DOUBLE_EQ(first.rms(), whole.rms());
  EXPECT_DOUBLE_EQ(first.rms(), std::sqrt((1 + 9 + 4 + 0.25) / 4));
}

TEST(FittedParameters, HeldUnknownsHaveNoVarianceAndNoCorrelation) {
  const Eigen::VectorXd unknowns{{2.0, 0.0, 3.0}};
  const Eigen::MatrixXd of_free{{4.0, 1.0}, {1.0, 9.0}};
  const Eigen::MatrixXd covariance = spread_over(unknowns.size(), above_zero(unknowns), of_free);
  const model::Fit fit = known_from("three", {"a", "b", "c"}, {unknowns.begin(), unknowns.end()}, covariance);
  EXPECT_EQ(fit.parameters[0].uncertainty, 2);
  EXPECT_EQ(fit.parameters[1].uncertainty, 0);
  EXPECT_EQ(fit.parameters[2].uncertainty, 3);
  EXPECT_DOUBLE_EQ(fit.correlation[2], 1.0 / 6);
  EXPECT_EQ(fit.correlation[1], 0);
}

}  // namespace
}  // namespace spoolflow::calibration
