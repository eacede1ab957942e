#include "spoolflow/rig/numerics/noise.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

TEST(Noise, RepeatsForTheSameSeedAndStream) {
  Noise one(7, "shunt"), two(7, "shunt");
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(one.normal(), two.normal());
  }
}

/// The first numbers of a stream are part of the contract: recordings made from a seed stay what they were.
TEST(Noise, GivesTheNumbersItAlwaysGave) {
  Noise noise(1, "lvdt");
  EXPECT_EQ(noise.uniform(), 0x1.74e3507b883bp-5);
  EXPECT_EQ(noise.uniform(), 0x1.ce32f2acab8fdp-1);
  EXPECT_DOUBLE_EQ(noise.normal(), 0x1.7d8c4a3471bb5p+0);
}

TEST(Noise, DiffersBetweenSeedsAndBetweenStreams) {
  EXPECT_NE(Noise(1, "shunt").uniform(), Noise(2, "shunt").uniform());
  EXPECT_NE(Noise(1, "shunt").uniform(), Noise(1, "voltage").uniform());
}

TEST(Noise, IsNormalInItsFirstFourMoments) {
  Noise noise(3, "moments");
  const int count = 400000;
  double sum = 0, square = 0, cube = 0, fourth = 0;
  for (int k = 0; k < count; ++k) {
    const double z = noise.normal();
    sum += z;
    square += z * z;
    cube += z * z * z;
    fourth += z * z * z * z;
  }
  // Five standard errors: sqrt(1, 2, 15, 96)/sqrt(count).
  const double error = 5 / std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(sum / count, 0, error);
  EXPECT_NEAR(square / count, 1, std::sqrt(2.0) * error);
  EXPECT_NEAR(cube / count, 0, std::sqrt(15.0) * error);
  EXPECT_NEAR(fourth / count, 3, std::sqrt(96.0) * error);
}

TEST(Noise, HasNormalTails) {
  Noise noise(4, "tails");
  const int count = 1000000;
  int beyond_three = 0;
  for (int k = 0; k < count; ++k) {
    beyond_three += std::abs(noise.normal()) > 3;
  }
  EXPECT_NEAR(beyond_three, 2700, 5 * std::sqrt(2700.0));
}

TEST(Noise, ShowsNoMemoryFromOneNumberToTheNext) {
  Noise noise(5, "memory");
  const int count = 200000;
  double before = noise.normal(), product = 0;
  for (int k = 0; k < count; ++k) {
    const double now = noise.normal();
    product += now * before;
    before = now;
  }
  EXPECT_NEAR(product / count, 0, 5 / std::sqrt(static_cast<double>(count)));
}

TEST(Noise, WaitsAsLongAsThePoissonProcessSays) {
  Noise noise(6, "events");
  double total_s = 0;
  for (int k = 0; k < 100000; ++k) {
    total_s += noise.waiting_time_s(0.25);
  }
  EXPECT_NEAR(total_s / 100000, 4, 5 * 4 / std::sqrt(100000.0));
  EXPECT_TRUE(std::isinf(noise.waiting_time_s(0)));
}

}  // namespace
}  // namespace spoolflow::rig
