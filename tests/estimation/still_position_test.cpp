#include "spoolflow/estimation/still_position.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::estimation {
namespace {

constexpr double largest_A = 2.0;

/// A spool that swings by a millimetre, at 1 kHz, under a current that swings along.
struct Swing {
  std::minstd_rand random{3};
  std::normal_distribution<double> normal{};
  int k = 0;
  double rate = 0.02;  ///< rad a sample

  double current_A() const { return 1 + 0.5 * std::sin(rate * k); }
  double position_m() { return 1e-3 + 5e-4 * std::sin(rate * k) + 1e-6 * normal(random); }
};

/// First sample of `samples` at which the position is said to hang; -1: none. It is held from `stuck` on.
int reported_at(Swing swing, int samples, int stuck, double resolution_m, int hold = 1) {
  StillPosition still;
  double held_m = 0;
  for (int k = 0; k < samples; ++k) {
    swing.k = k;
    const double position_m = std::round(swing.position_m() / resolution_m) * resolution_m;
    if (k < stuck && k % hold == 0) held_m = position_m;
    if (still.hangs(hold > 1 || k >= stuck ? held_m : position_m, swing.current_A(), largest_A)) return k;
    if (hold == 1 && k < stuck) held_m = position_m;
  }
  return -1;
}

TEST(StillPosition, HangsWhereANoisyChannelRepeatsItselfUnderAMovingCurrent) {
  const int reported = reported_at({.rate = 0.004}, 12'000, 10'020, 1e-8);
  EXPECT_GT(reported, 10'040);
  EXPECT_LT(reported, 10'300);  // the current moves by some hundredths first
}

TEST(StillPosition, CoarseChannelIsSound) {
  for (const double resolution_m : {1e-6, 2e-6, 5e-6, 2e-5})
    EXPECT_EQ(reported_at({}, 40'000, 40'000, resolution_m), -1);
}

TEST(StillPosition, CoarseChannelThatRestsAndStartsLateIsSound) {
  for (const double resolution_m : {5e-6, 2e-5}) {
    StillPosition still;
    const auto coarse = [resolution_m](double position_m) {
      return std::round(position_m / resolution_m) * resolution_m;
    };
    Swing swing;
    for (swing.k = 0; swing.k < 20'000; ++swing.k)
      ASSERT_FALSE(still.hangs(coarse(swing.position_m()), swing.current_A(), largest_A));
    for (int k = 0; k < 500; ++k) ASSERT_FALSE(still.hangs(coarse(1.2e-3), 1.0, largest_A));
    for (int k = 0; k < 300; ++k) ASSERT_FALSE(still.hangs(coarse(1.2e-3), 1.0 + 1e-3 * k, largest_A));  // friction
  }
}

TEST(StillPosition, ChannelThatHoldsEachValueForTenSamplesIsSound) {
  EXPECT_EQ(reported_at({}, 60'000, 60'000, 1e-8, 10), -1);
}

TEST(StillPosition, SpoolAtRestUnderASteadyCurrentIsNotBlamed) {
  StillPosition still;
  Swing swing;
  for (swing.k = 0; swing.k < 5000; ++swing.k)
    EXPECT_FALSE(still.hangs(swing.position_m(), swing.current_A(), largest_A));
  for (int k = 0; k < 5000; ++k) EXPECT_FALSE(still.hangs(1e-3, 1.0, largest_A));
}

TEST(StillPosition, StopAtTheEndOfTheRangeIsNotBlamed) {
  StillPosition still;
  Swing swing;
  for (swing.k = 0; swing.k < 5000; ++swing.k)
    EXPECT_FALSE(still.hangs(swing.position_m(), swing.current_A(), largest_A));
  for (; swing.k < 9000; ++swing.k) EXPECT_FALSE(still.hangs(2e-3, swing.current_A(), largest_A));
}

}  // namespace
}  // namespace spoolflow::estimation
