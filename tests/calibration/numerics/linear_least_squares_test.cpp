/// Unknowns of a linear law, and how well its rows determine them.
#include "spoolflow/calibration/numerics/linear_least_squares.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

using ::testing::HasSubstr;

struct Line {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

/// 2 + 3 x over x = -1 to 1 with noise of 0.1 that a share `alike` of is the sample before's.
Line noisy_line(std::mt19937& random, double alike) {
  constexpr int count = 400;
  std::normal_distribution<double> normal(0, 0.1);
  Line out{Eigen::MatrixXd(count, 2), Eigen::VectorXd(count)};
  double noise = normal(random);
  for (int k = 0; k < count; ++k) {
    const double x = -1 + 2.0 * k / (count - 1);
    noise = alike * noise + std::sqrt(1 - alike * alike) * normal(random);
    out.matrix.row(k) << 1, x;
    out.right(k) = 2 + 3 * x + noise;
  }
  return out;
}

/// How far the slope scatters over many lines, and what a fit says of it on average.
std::pair<double, double> scatter_and_said(double alike, bool in_a_row) {
  constexpr int lines = 300;
  std::mt19937 random(7);
  double squares = 0, said = 0;
  for (int k = 0; k < lines; ++k) {
    const Line line = noisy_line(random, alike);
    const LinearLeastSquares fit = least_squares(line.matrix, line.right, "a line");
    squares += std::pow(fit.solution(1) - 3, 2) / lines;
    said += (in_a_row ? fit.covariance(independent_in_a_row(fit.deviation)) : fit.covariance())(1, 1) / lines;
  }
  return {std::sqrt(squares), std::sqrt(said)};
}

TEST(LinearLeastSquares, SaysHowFarASlopeScattersThatWasMeasuredPointByPoint) {
  const auto [scatter, said] = scatter_and_said(0, false);
  EXPECT_NEAR(said, scatter, 0.15 * scatter);
}

TEST(LinearLeastSquares, CountsSamplesInARowOnlyAsFarAsTheyAreIndependent) {
  const auto [scatter, said] = scatter_and_said(0.9, true);
  EXPECT_NEAR(said, scatter, 0.2 * scatter);
  EXPECT_LT(scatter_and_said(0.9, false).second, 0.4 * scatter);  // taken for independent, they say too much
}

TEST(LinearLeastSquares, RefusesRowsThatDoNotSeparateTheUnknowns) {
  Eigen::MatrixXd twins(3, 2);
  twins << 1, 2, 2, 4, 3, 6;
  EXPECT_THAT([&] { (void)least_squares(twins, Eigen::VectorXd::Ones(3), "the spring"); },
              ::testing::ThrowsMessage<CalibrationError>(
                  HasSubstr("the spring cannot be identified: 3 values do not determine 2 unknowns")));
}

}  // namespace
}  // namespace spoolflow::calibration
