#include "spoolflow/uncertainty/budget.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::uncertainty {
namespace {

BudgetLine line(InputQuantity quantity, double contribution, double degrees_of_freedom) {
  BudgetLine out;
  out.input.quantity = quantity;
  out.contribution_m3_per_s = contribution;
  out.degrees_of_freedom = degrees_of_freedom;
  return out;
}

TEST(Budget, ReproducesTheEndGaugeOfJcgm100H1) {
  const Budget budget =
      combine({line(InputQuantity::position_zero, 25, 18), line(InputQuantity::current_gain, 9.7, 25.6),
               line(InputQuantity::spring, 2.9, 50), line(InputQuantity::friction, 16.6, 2)},
              {});
  EXPECT_NEAR(budget.combined_m3_per_s, 31.7, 0.1);
  EXPECT_NEAR(budget.degrees_of_freedom, 16.7, 0.5);
  EXPECT_NEAR(budget.coverage_factor, 2.11, 0.02);
  EXPECT_DOUBLE_EQ(budget.expanded_m3_per_s, budget.coverage_factor * budget.combined_m3_per_s);
}

TEST(Budget, SharesAddUpToOneWithCorrelationsToo) {
  const Budget budget = combine({line(InputQuantity::spring, -3, 8), line(InputQuantity::flow_force_map, -5, 8),
                                 line(InputQuantity::friction, 2, std::numeric_limits<double>::infinity())},
                                {{InputQuantity::spring, InputQuantity::flow_force_map, -0.6, ""}});
  double sum = 0;
  for (const BudgetLine& each : budget.lines) sum += each.share;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(budget.combined_m3_per_s, std::sqrt(9 + 25 - 2 * 0.6 * 15 + 4), 1e-12);
}

TEST(Budget, ErrorsInCommonThatOpposeEachOtherCancel) {
  const Budget budget = combine({line(InputQuantity::spring, 4, 8), line(InputQuantity::flow_force_map, 4, 8)},
                                {{InputQuantity::spring, InputQuantity::flow_force_map, -1, ""}});
  EXPECT_NEAR(budget.combined_m3_per_s, 0, 1e-12);
  EXPECT_TRUE(std::isfinite(budget.expanded_m3_per_s));
}

TEST(Budget, CorrelatedInputsCountAsOneInTheDegreesOfFreedom) {
  std::vector<BudgetLine> lines{line(InputQuantity::spring, 3, 8), line(InputQuantity::flow_force_map, 4, 20)};
  for (BudgetLine& each : lines) each.share = 0.5;
  const std::vector<Correlation> correlations{{InputQuantity::spring, InputQuantity::flow_force_map, 0.3, ""}};
  EXPECT_DOUBLE_EQ(effective_degrees_of_freedom(lines, correlations), 8);
  EXPECT_DOUBLE_EQ(effective_degrees_of_freedom(lines, {}), 1 / (0.25 / 8 + 0.25 / 20));
}

TEST(Distribution, CoverageFactorsAreThoseOfJcgm100TableG2) {
  for (const auto& [nu, k] : {std::pair{1.0, 12.71},
                              {2.0, 4.30},
                              {5.0, 2.57},
                              {10.0, 2.23},
                              {50.0, 2.01},
                              {1000.0, 1.962},
                              {std::numeric_limits<double>::infinity(), 1.960}}) {
    EXPECT_NEAR(coverage_factor_95(nu), k, 0.006) << nu;
  }
}

TEST(Distribution, QuantilesAreInStandardDeviations) {
  EXPECT_NEAR(quantile(Distribution::normal, 0.975), 1.95996, 1e-5);
  EXPECT_NEAR(quantile(Distribution::normal, 1e-4), -3.71902, 1e-5);
  EXPECT_NEAR(quantile(Distribution::rectangular, 1.0), std::sqrt(3.0), 1e-12);
  for (const Distribution each : {Distribution::normal, Distribution::rectangular, Distribution::two_point}) {
    double squares = 0;
    constexpr int parts = 20000;
    for (int k = 0; k < parts; ++k) squares += std::pow(quantile(each, (k + 0.5) / parts), 2) / parts;
    EXPECT_NEAR(squares, 1, 2e-3) << name(each);
  }
  EXPECT_NEAR(normal_share_below(normal_quantile(0.123)), 0.123, 1e-8);
}

}  // namespace
}  // namespace spoolflow::uncertainty
