#include "spoolflow/monitor/cusum.hpp"

#include <random>

#include <gtest/gtest.h>

#include "spoolflow/monitor/direction_monitor.hpp"

namespace spoolflow::monitor {
namespace {

/// Mean of the scores until an alarm, over seeded runs.
double simulated_run_length(double allowance, double limit, double mean, int runs) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal(mean, 1);
  double sum = 0;
  for (int run = 0; run < runs; ++run) {
    Cusum cusum;
    while (!cusum.raised) {
      follow(cusum, normal(generator), allowance, limit);
      ++sum;
    }
  }
  return sum / runs;
}

// Brook and Evans (1972), Biometrika 59, table 1 for one side: k = 0.5, h = 3 and h = 4 give 117.6 and 335.4.
TEST(AverageRunLength, IsThatOfTheLiterature) {
  EXPECT_NEAR(average_run_length(0.5, 3), 117.6, 0.5);
  EXPECT_NEAR(average_run_length(0.5, 4), 335.4, 1.0);
}

TEST(AverageRunLength, OfTheMarkovChainIsThatOfSimulatedScores) {
  // The mean of n run lengths scatters by about itself over the root of n.
  for (const auto& [allowance, limit] : {std::pair{0.5, 3.0}, {1.0, 2.0}, {1.5, 1.5}}) {
    const double chain = average_run_length(allowance, limit);
    EXPECT_NEAR(simulated_run_length(allowance, limit, 0, 4000) / chain, 1, 0.06) << allowance;
  }
}

TEST(AverageRunLength, AShiftIsFoundInAsManyScoresAsTheChainSays) {
  EXPECT_NEAR(simulated_run_length(1.5, 4.5, 3.0, 4000) / average_run_length(1.5, 4.5, 3.0), 1, 0.03);
}

TEST(Limits, GiveTheWantedRateOfFalseAlarms) {
  const Limits limits = limits_for(1);
  const double wanted = 2 * windows_per_year * static_cast<double>(charts);
  EXPECT_NEAR(average_run_length(cusum_allowance, limits.sum) / wanted, 1, 0.01);
  EXPECT_NEAR(0.5 * std::erfc(limits.single / std::sqrt(2.0)) * wanted, 1, 1e-6);
  EXPECT_LT(limits_for(10).sum, limits.sum);
}

// With a rate high enough to be simulated: alarms of all charts together over many valve-years of independent scores.
TEST(Limits, AllChartsTogetherKeepTheRate) {
  constexpr double per_year = 20000;
  const Limits limits = limits_for(per_year);
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal(0, 1);
  double alarms = 0;
  constexpr int windows = 400000;
  std::array<Cusum, charts> all{};
  for (int window = 0; window < windows; ++window) {
    for (Cusum& chart : all) {
      follow(chart, normal(generator), cusum_allowance, limits.sum, limits.single);
      if (!chart.raised) continue;
      ++alarms;
      chart = {};
    }
  }
  const double years = windows / windows_per_year;
  // A single score beyond its limit often brings the sum beyond its own: fewer than both add up to.
  EXPECT_LT(alarms / (years * per_year), 1.05);
  EXPECT_GT(alarms / (years * per_year), 0.5);
}

TEST(Cusum, LatchesUntilTheScoresHaveFallenForLong) {
  Cusum cusum;
  for (int k = 0; k < 10; ++k) follow(cusum, 3, 1.5, 4.5);
  EXPECT_TRUE(cusum.raised);
  follow(cusum, 0, 1.5, 4.5);
  EXPECT_TRUE(cusum.raised);
  for (int k = 0; k < 20; ++k) follow(cusum, 0, 1.5, 4.5);
  EXPECT_FALSE(cusum.raised);
}

}  // namespace
}  // namespace spoolflow::monitor
