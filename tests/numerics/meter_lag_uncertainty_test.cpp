#include "spoolflow/numerics/meter_lag_uncertainty.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::numerics {
namespace {

/// Twenty seconds of steps and ramps at 1 kHz, what a meter shows of them with noise, and what a sensor says of them
/// with errors that last for a quarter of a second each.
struct Metered {
  std::vector<double> time_s, flow, shown;
};

Metered metered(const MeterLag& meter, unsigned seed, double noise, double error) {
  Metered out;
  std::minstd_rand random(seed);
  std::normal_distribution<double> normal;
  double flow = 0, rate = 0;
  for (int k = 0; k < 20'000; ++k) {
    if (k % 700 == 0) rate = 0.004 * normal(random);
    if (k % 1900 == 0) flow = 4 * normal(random);
    out.time_s.push_back(1e-3 * k);
    out.flow.push_back(flow += rate);
  }
  out.shown = out.flow;
  apply_lag<double>(out.time_s, out.shown, meter);
  double lasting = 0;
  for (std::size_t k = 0; k < out.flow.size(); ++k) {
    out.shown[k] += noise * normal(random);
    lasting += (error * normal(random) * std::sqrt(2.0 / 250) - lasting / 250);
    out.flow[k] += lasting;
  }
  return out;
}

TEST(MeterLagUncertainty, HoldsTheTrueLagAndDeadTimeInNearlyAllRuns) {
  int runs = 0, lag_held = 0, dead_time_held = 0;
  for (const MeterLag& meter : {MeterLag{0.012, 0.03}, MeterLag{0.02, 0.06}}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Metered run = metered(meter, seed, 0.05, 0.1);
      const MeterLag found = find_meter_lag(run.time_s, run.flow, run.shown).value_or(MeterLag{});
      const auto uncertainty = meter_lag_uncertainty(run.time_s, run.flow, run.shown, found);
      ASSERT_TRUE(uncertainty);
      ++runs;
      lag_held += std::abs(found.lag_s - meter.lag_s) <= uncertainty->lag_s ? 1 : 0;
      dead_time_held += std::abs(found.dead_time_s - meter.dead_time_s) <= uncertainty->dead_time_s ? 1 : 0;
    }
  }
  RecordProperty("lag_held", lag_held);
  RecordProperty("dead_time_held", dead_time_held);
  EXPECT_GE(lag_held, 0.9 * runs);
  EXPECT_GE(dead_time_held, 0.9 * runs);
}

TEST(MeterLagUncertainty, GrowsWithTheErrorsOfTheRun) {
  const MeterLag meter{0.01, 0.04};
  double last_s = 0;
  for (const double error : {0.02, 0.07, 0.2}) {
    const Metered run = metered(meter, 5, error / 4, error);
    const auto uncertainty = meter_lag_uncertainty(
        run.time_s, run.flow, run.shown, find_meter_lag(run.time_s, run.flow, run.shown).value_or(MeterLag{}));
    ASSERT_TRUE(uncertainty);
    EXPECT_GT(uncertainty->lag_s, last_s);
    EXPECT_LT(uncertainty->lag_s, meter.lag_s);
    last_s = uncertainty->lag_s;
  }
}

TEST(MeterLagUncertainty, IsNotStatedWhereNoLagWasFound) {
  const Metered run = metered({0, 0.03}, 1, 0.05, 0.1);
  EXPECT_FALSE(meter_lag_uncertainty(run.time_s, run.flow, run.shown, {}));
}

}  // namespace
}  // namespace spoolflow::numerics
