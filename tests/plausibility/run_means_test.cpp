/// What of a run is kept while it streams by: means, gaps, the resolution of its position.
#include "spoolflow/plausibility/run_means.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

TEST(RunMeans, KeepTheMeanOfEveryStretchHoweverLongTheRun) {
  RunMeans means;
  recording::SampleBlock block;
  block.rows = 1000;
  std::vector<double>& time_s = block.columns[static_cast<std::size_t>(Channel::time)];
  std::vector<double>& position_m = block.columns[static_cast<std::size_t>(Channel::position)];
  for (int blocks = 0; blocks < 100; ++blocks) {
    time_s.clear();
    position_m.clear();
    for (int k = 0; k < 1000; ++k) {
      time_s.push_back(1e-3 * (1000 * blocks + k));
      position_m.push_back(k % 10 == 0 ? std::nan("") : 2 * time_s.back());
    }
    means.take(block);
  }
  const recording::Recording out = means.means("run.csv");
  ASSERT_GT(out.size(), 1000U);
  ASSERT_LE(out.size(), 4000U);
  for (std::size_t k = 0; k < out.size(); ++k)
    EXPECT_NEAR(out.column(Channel::position)[k], 2 * out.column(Channel::time)[k], 0.02) << k;
  EXPECT_EQ(means.gaps().count, 0U);
}

TEST(RunMeans, AStretchOfTimeWithoutSamplesIsAGap) {
  RunMeans means;
  recording::SampleBlock block;
  block.rows = 3;
  block.columns[static_cast<std::size_t>(Channel::time)] = {0.0, 0.001, 5.001};
  means.take(block);
  EXPECT_EQ(means.gaps().count, 1U);
  EXPECT_DOUBLE_EQ(means.gaps().longest_s, 5.0);
  EXPECT_NEAR(means.gaps().longest_from_s, 0.001, 1e-9);
}

TEST(PositionResolution, IsTheNoiseOfASpoolInMotionAndAtRest) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 2e-6);
  PositionResolution resolution;
  for (int block = 0; block < 10; ++block) {
    std::vector<double> time_s, position_m;
    for (int k = 0; k < 3000; ++k) {
      time_s.push_back(1e-3 * (3000 * block + k));
      position_m.push_back(1.2e-3 + (block % 2 == 0 ? 1e-3 * std::sin(20 * time_s.back()) : 0) + noise(random));
    }
    position_m[17] = std::nan("");
    position_m[1000] = 5e-3;  // a fault
    resolution.take(time_s, position_m);
  }
  EXPECT_NEAR(resolution.noise_m(), 2e-6, 0.1e-6);
  EXPECT_TRUE(std::isnan(PositionResolution().noise_m()));
  EXPECT_EQ(PositionResolution().step_m(), 0);
}

TEST(PositionResolution, IsNotTheSpoolsMotionUnderDither) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.3e-6);
  std::vector<double> time_s, position_m;
  for (int k = 0; k < 30000; ++k) {
    time_s.push_back(1e-3 * k);
    const double swing = 4 * std::sin(2 * std::numbers::pi * 110 * time_s.back());
    const bool shaken = k < 24000;  // 25 um peak to peak, nearly rectangular, as dither moves a light spool
    position_m.push_back(0.7e-3 + (shaken ? 12.5e-6 * std::clamp(swing, -1.0, 1.0) : 0) + noise(random));
  }
  PositionResolution resolution;
  resolution.take(time_s, position_m);
  EXPECT_NEAR(resolution.noise_m(), 0.3e-6, 0.03e-6);
  PositionResolution always_shaken;
  always_shaken.take(std::span(time_s).first(20000), std::span(position_m).first(20000));
  EXPECT_TRUE(std::isnan(always_shaken.noise_m()));
}

}  // namespace
}  // namespace spoolflow::plausibility
