/// Friction at rest, on contacts whose friction is known.
#include "spoolflow/sensor/friction.hpp"

#include <random>
#include <string>

#include <gtest/gtest.h>

namespace spoolflow::sensor {
namespace {

constexpr FrictionParameters<double> contact{.ageing_ratio = 1.5,
                                             .ageing_s = 2.5,
                                             .contact_stiffness_N_per_m = 1e6,
                                             .tolerance_N = 0.3,
                                             .breakaway_share = 0.12,
                                             .operation_ratio = 1};
constexpr PositionSensor<double> fine_lvdt{.noise_m = 0.3e-6,
                                           .backlash_m = 0.4e-6,
                                           .drift_m_per_K = 0,
                                           .drift_free_K = 313,
                                           .hardest_acceleration_m_per_s2 = 90};
constexpr double spool_N = 4;
constexpr double armature_N = 1;

class Friction : public testing::TestWithParam<double> {
 protected:
  /// One sample; `residual_N` is what the estimated pressure difference leaves.
  FrictionInterval<double> sample(Motion motion, double position_m, double residual_N, double direction = 1) {
    const FrictionBounds<double> bounds = friction_bounds(contact, state, spool_N, armature_N);
    dragged_m_ = std::clamp(dragged_m_, position_m - fine_lvdt.backlash_m, position_m + fine_lvdt.backlash_m);
    PositionPoint<double> point{dragged_m_ + noise_times * noise_(generator_), motion, direction * 1e-6};
    point.noise_times = learnt_times;
    const Due<double> memory{true, GetParam()};  // a block of positions is one sample
    return step(contact, state, bounds, fine_lvdt, point, residual_N, creeps, memory, GetParam());
  }
  /// Slides, opening or closing, then stops at 1 mm.
  void stop_after(double direction) {
    dragged_m_ = direction > 0 ? 0 : 2e-3;
    for (double time_s = 0; time_s < 0.2; time_s += GetParam()) {
      sample(direction > 0 ? Motion::opening : Motion::closing, 1e-3, direction * (spool_N + armature_N), direction);
    }
  }
  FrictionState<double> state{};
  bool creeps = false;
  double noise_times = 1, learnt_times = 1;  ///< the calibrated noise: what there is, and what the track has learnt

 private:
  std::mt19937 generator_{11};
  std::normal_distribution<double> noise_{0, fine_lvdt.noise_m};
  double dragged_m_ = 0;
};
INSTANTIATE_TEST_SUITE_P(SampledEvery, Friction, testing::Values(50e-6, 200e-6, 1e-3, 5e-3),
                         [](const auto& rate) { return std::to_string(static_cast<int>(1e6 * rate.param)) + "us"; });

TEST_P(Friction, UnderDitherMayLieAnywhereThatTheContactsHold) {
  stop_after(1);
  creeps = true;
  const FrictionInterval<double> interval = sample(Motion::rest, 1e-3, spool_N + armature_N);
  const double sticking_N = friction_bounds(contact, state, spool_N, armature_N).sticking_N;
  EXPECT_NEAR(interval.lower_N, -sticking_N, 0.01 * sticking_N);
  EXPECT_NEAR(interval.upper_N, sticking_N, 0.01 * sticking_N);
}

TEST_P(Friction, StartsARestWhereItsSlidingEnded) {
  for (const double direction : {1.0, -1.0}) {
    stop_after(direction);
    const double friction_N = direction * (spool_N + armature_N);
    FrictionInterval<double> interval{};
    for (double time_s = 0; time_s < 0.3; time_s += GetParam()) {
      interval = sample(Motion::rest, 1e-3, friction_N);
      EXPECT_LE(interval.lower_N, friction_N + 0.85);
      EXPECT_GE(interval.upper_N, friction_N - 0.85);
    }
    EXPECT_LT(interval.upper_N - interval.lower_N, 2.5);  // the limits lie 10 N apart
  }
}

TEST_P(Friction, IsFollowedAcrossItsWidthByThePreSlidingDisplacement) {
  stop_after(1);
  // Friction goes from 5 to -3 N in 2 s; by Dahl's law (the contact's stiffness fades towards +-limit) the spool creeps
  // back by some 10 um.
  double friction_N = spool_N + armature_N, creep_m = 0;
  int held = 0, samples = 0;
  for (double time_s = 0; time_s < 2; time_s += GetParam()) {
    const double holds_N = spool_N * (1 + 0.5 * time_s / (2.5 + time_s)) + armature_N + 0.6;
    const double change_N = -4 * GetParam();
    creep_m += change_N / (contact.contact_stiffness_N_per_m * std::max(0.1, std::min(1.0, 1 + friction_N / holds_N)));
    friction_N += change_N;
    const FrictionInterval<double> interval = sample(Motion::rest, 1e-3 + creep_m, friction_N);
    const double tolerance_N = 2 * contact.tolerance_N;  // what the gauge itself may be wrong by
    held += interval.lower_N - tolerance_N <= friction_N && friction_N <= interval.upper_N + tolerance_N ? 1 : 0;
    EXPECT_LT(interval.upper_N - interval.lower_N, 1.5);  // of 10 N between the limits
    ++samples;
  }
  EXPECT_GT(held, 0.95 * samples);
}

TEST_P(Friction, OfContactsThatCreepOnIsThatOfYoungOnes) {
  // Aged contacts are loaded to their limit, and the spool crawls on from there.
  const auto aged_share_after = [&](double creep_m) {
    stop_after(1);
    const auto aged_N = [&] {
      const FrictionBounds<double> bounds = friction_bounds(contact, state, spool_N, armature_N);
      return bounds.sticking_N - bounds.sliding_N;
    };
    for (double time_s = 0; time_s < 10; time_s += GetParam()) sample(Motion::rest, 1e-3, spool_N + armature_N);
    const double rested_N = aged_N();
    constexpr double creeps_s = 1;
    for (double time_s = 0; time_s < creeps_s; time_s += GetParam())
      sample(Motion::rest, 1e-3 + creep_m * time_s / creeps_s, spool_N + armature_N);
    return aged_N() / rested_N;
  };
  EXPECT_GT(aged_share_after(0.5e-6), 0.95);
  EXPECT_LT(aged_share_after(200e-6), 0.3);
}

TEST_P(Friction, IsNotMovedByNoiseThatTheTrackHasLearntOf) {
  const double friction_N = 0.5 * (spool_N + armature_N);
  const auto moved_N = [&] {
    stop_after(1);
    for (double time_s = 0; time_s < 0.5; time_s += GetParam()) sample(Motion::rest, 1e-3, friction_N);
    double lowest_N = state.presliding_N, highest_N = state.presliding_N;
    for (double time_s = 0; time_s < 5; time_s += GetParam()) {
      sample(Motion::rest, 1e-3, friction_N);
      lowest_N = std::min(lowest_N, state.presliding_N);
      highest_N = std::max(highest_N, state.presliding_N);
    }
    return highest_N - lowest_N;
  };
  const double quiet_N = moved_N();
  noise_times = 6;
  const double surprised_N = moved_N();
  learnt_times = 6;
  EXPECT_LT(moved_N(), 0.5 * surprised_N);
  EXPECT_LT(quiet_N, 0.5 * surprised_N);
}

TEST_P(Friction, FindsTheForceAtWhichTheSpoolBrokeAwayNotThatOfTheSlip) {
  stop_after(1);
  double residual_N = 5;
  for (double time_s = 0; time_s < 1; time_s += GetParam()) sample(Motion::rest, 1e-3, residual_N = 5 + 1.2 * time_s);
  const double breakaway_N = residual_N;
  // Inertia takes part of the force as soon as the spool goes; motion is found a block later.
  FrictionInterval<double> interval{};
  int breakaways = 0;
  for (int k = 0; k < 3; ++k) {
    interval = sample(Motion::transient, 1.02e-3, 2.0);
    if (interval.breakaway_N == 0) continue;
    ++breakaways;
    EXPECT_NEAR(interval.breakaway_N, breakaway_N, 0.05);
    EXPECT_NEAR(interval.rested_s, 1, 0.02);
  }
  EXPECT_EQ(breakaways, 1);
}

TEST(Ageing, GrowsFromSlidingFrictionToItsLimitAndIsHalfwayAtItsTimeConstant) {
  EXPECT_DOUBLE_EQ(ageing(contact, 0.0), 1);
  EXPECT_DOUBLE_EQ(ageing(contact, contact.ageing_s), 1.25);
  EXPECT_NEAR(ageing(contact, 1e4), contact.ageing_ratio, 1e-3);
}

}  // namespace
}  // namespace spoolflow::sensor
