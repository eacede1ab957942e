/// Solenoid bench recordings with dither on the current: means over its periods, or a clear refusal.
#include "spoolflow/calibration/fits/bench_dither.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

/// 20 s at 200 Hz: the current rises slowly, the force with it; dither of both where `amplitude_A` > 0.
recording::Recording slow_map(double amplitude_A, double frequency_Hz) {
  recording::Recording out;
  for (int k = 0; k < 4000; ++k) {
    const double time_s = 5e-3 * k;
    const double slow_A = 0.1 * time_s + 2e-3 * std::sin(37.0 * k * k);  // a recorder's noise
    const double dither_A = amplitude_A * std::sin(2 * std::numbers::pi * frequency_Hz * time_s + 0.7);
    out.column(Channel::time).push_back(time_s);
    out.column(Channel::current).push_back(slow_A + dither_A);
    out.column(Channel::force).push_back(20 * slow_A + 10 * dither_A);
  }
  return out;
}

TEST(BenchDither, MeansOfADitheredMapAreThoseOfTheMapWithoutDither) {
  const recording::Recording plain = slow_map(0, 0);
  for (const double frequency_Hz : {80.0, 100.0, 125.0, 160.0, 230.0}) {
    const recording::Recording means = without_dither(slow_map(0.2, frequency_Hz));
    for (std::size_t k = 40; k + 40 < plain.size(); ++k) {
      EXPECT_NEAR(means[Channel::current][k], 0.1 * plain[Channel::time][k], 6e-3) << frequency_Hz;
      EXPECT_NEAR(means[Channel::force][k], 2 * plain[Channel::time][k], 0.12) << frequency_Hz;
    }
  }
}

TEST(BenchDither, MapWithoutDitherStaysAsItIs) {
  const recording::Recording plain = slow_map(0, 0);
  EXPECT_EQ(without_dither(plain).columns, plain.columns);
}

TEST(BenchDither, SlowlyRecordedDitherOfTheDynamicTestsIsRefused) {
  EXPECT_NO_THROW(require_resolved_dither(slow_map(0, 0)));
  EXPECT_THROW(require_resolved_dither(slow_map(0.1, 160)), CalibrationError);
}

}  // namespace
}  // namespace spoolflow::calibration
