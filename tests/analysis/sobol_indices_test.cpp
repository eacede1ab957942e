#include "spoolflow/analysis/sobol_indices.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/analysis/ishigami.hpp"

namespace spoolflow::analysis {
namespace {

std::vector<double> evaluated(const SaltelliDesign& design, double (*function)(const std::vector<double>&)) {
  std::vector<double> outputs;
  for (std::size_t k = 0; k < design.points(); ++k) outputs.push_back(function(design.point(k)));
  return outputs;
}

TEST(SobolIndices, ReproduceIshigamiWithinTheirConfidenceIntervals) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const SelfCheck check = check_ishigami(1024, seed);
    EXPECT_TRUE(check.passed) << "seed " << seed;
    EXPECT_NEAR(check.first_order[0], 0.314, 5e-4);
    EXPECT_NEAR(check.first_order[1], 0.442, 5e-4);
    EXPECT_NEAR(check.total[0], 0.558, 5e-4);
    EXPECT_NEAR(check.total[2], 0.244, 5e-4);
    for (std::size_t f = 0; f < 3; ++f) {
      EXPECT_NEAR(check.found.factors[f].first_order.value, check.first_order[f], 0.03);
      EXPECT_NEAR(check.found.factors[f].total.value, check.total[f], 0.03);
    }
  }
}

TEST(SobolIndices, OfASumAreTheSharesOfItsVarianceAndGroupsAddUp) {
  const SaltelliDesign design({1, 2, 1}, 256, 5);
  const auto sum = [](const std::vector<double>& u) { return 3 * u[0] + 2 * u[1] + u[2] + 0 * u[3]; };
  const SobolIndices found = sobol_indices(design, evaluated(design, sum), 5);
  for (const auto& [factor, share] : {std::pair{0, 9.0 / 14}, std::pair{1, 5.0 / 14}, std::pair{2, 0.0}}) {
    EXPECT_NEAR(found.factors[static_cast<std::size_t>(factor)].first_order.value, share, 0.02);
    EXPECT_NEAR(found.factors[static_cast<std::size_t>(factor)].total.value, share, 0.02);
  }
  EXPECT_NEAR(found.mean, 3, 0.01);
  EXPECT_NEAR(found.standard_deviation, std::sqrt(14.0 / 12), 0.01);
}

TEST(SobolIndices, AreZeroWhereNothingVaries) {
  const SaltelliDesign design({1, 1}, 16, 1);
  const SobolIndices found = sobol_indices(design, std::vector<double>(design.points(), 4.0), 1);
  EXPECT_EQ(found.factors[0].total.value, 0);
  EXPECT_EQ(found.factors[1].first_order.upper, 0);
}

TEST(SobolIndices, SeparateWhatOnlyActsTogether) {
  const SaltelliDesign design({1, 1}, 1024, 2);
  const auto product = [](const std::vector<double>& u) { return (u[0] - 0.5) * (u[1] - 0.5); };
  const SobolIndices found = sobol_indices(design, evaluated(design, product), 2);
  EXPECT_NEAR(found.factors[0].first_order.value, 0, 0.05);
  EXPECT_NEAR(found.factors[0].total.value, 1, 0.05);
}

TEST(SobolPoints, FillEveryEqualStretchOnceInEveryDimension) {
  constexpr std::uint32_t points = 64;
  constexpr unsigned dimensions = 50;
  const SobolPoints sequence({.dimensions = dimensions, .points = points}, 9);
  for (unsigned d = 0; d < dimensions; ++d) {
    std::vector<int> hits(points);
    for (std::uint32_t k = 0; k < points; ++k) {
      const double value = sequence[{k, d}];
      ASSERT_TRUE(value > 0 && value < 1);
      ++hits[static_cast<std::size_t>(value * points)];
    }
    EXPECT_EQ(hits, std::vector<int>(points, 1)) << "dimension " << d;
  }
}

TEST(SobolPoints, FollowFromTheirSeed) {
  const SobolPoints one({.dimensions = 3, .points = 8}, 1);
  const SobolPoints same({.dimensions = 3, .points = 8}, 1);
  const SobolPoints other({.dimensions = 3, .points = 8}, 2);
  EXPECT_EQ((one[{5, 2}]), (same[{5, 2}]));
  EXPECT_NE((one[{5, 2}]), (other[{5, 2}]));
}

}  // namespace
}  // namespace spoolflow::analysis
