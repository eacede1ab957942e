#include "spoolflow/rig/plant/friction.hpp"

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

constexpr double cold_viscosity = 46e-6;

/// A contact without Stribeck and ageing: pure displacement-dependent friction.
FrictionConstants plain() {
  return friction_constants({.base_N = 4.0, .stiction_ratio = 1.0, .ageing_gain = 0.0}, cold_viscosity);
}

double force_after(const FrictionConstants& contact, FrictionState& state, double displacement_m) {
  const double level = breakaway_N(contact, 0.0, state.age, 0.0);
  slide(contact, state, displacement_m, level);
  return friction_force(contact, state, 0.0, 0.0, level).force_N;
}

TEST(RigFriction, DahlLimitSlidesAtItsLevelWithTheSignOfMotion) {
  FrictionState state;
  EXPECT_NEAR(force_after(plain(), state, 1e-3), 4.0, 1e-12);
  EXPECT_NEAR(force_after(plain(), state, -1e-3), -4.0, 1e-12);
}

TEST(RigFriction, PreSlidingStartsWithTheContactStiffness) {
  FrictionState state;
  const double displacement = 1e-9;
  EXPECT_NEAR(force_after(plain(), state, displacement) / displacement, Friction{}.contact_stiffness_N_per_m, 1e-3);
}

TEST(RigFriction, UnloadingFollowsMasingsRule) {
  // From sliding, F_unload(d) = W - 2 f(d/2) with f the first loading: what closes pre-sliding loops.
  for (double displacement = 1e-7; displacement < 1.2e-5; displacement += 3e-7) {
    FrictionState fresh, slid;
    const double first = force_after(plain(), fresh, 0.5 * displacement);
    force_after(plain(), slid, 1e-3);
    EXPECT_NEAR(force_after(plain(), slid, -displacement), 4.0 - 2.0 * first, 1e-9) << displacement;
  }
}

TEST(RigFriction, MinorLoopInsidePreSlidingCloses) {
  FrictionState state;
  force_after(plain(), state, 1e-3);
  const double at_reversal = force_after(plain(), state, -3e-6);
  force_after(plain(), state, 1.5e-6);
  EXPECT_NEAR(force_after(plain(), state, -1.5e-6), at_reversal, 1e-12);
}

TEST(RigFriction, StribeckLevelFallsFromStictionToSliding) {
  const FrictionConstants contact = friction_constants(
      {.base_N = 2.0, .stiction_ratio = 1.5, .ageing_gain = 0.0, .stribeck_velocity_m_per_s = 5e-3}, cold_viscosity);
  EXPECT_NEAR(breakaway_N(contact, 1.0, 0.0, 0.0), 4.5, 1e-12);
  EXPECT_NEAR(breakaway_N(contact, 1.0, 0.0, 5e-3), 3.75, 1e-12);
  EXPECT_NEAR(breakaway_N(contact, 1.0, 0.0, 1.0), 3.0, 1e-3);
}

TEST(RigFriction, BreakAwayGrowsWithTimeAtRestAndSlidingRenewsTheContact) {
  const Friction friction{.ageing_gain = 1.0, .ageing_time_s = 2.0, .ageing_distance_m = 3e-5};
  const FrictionConstants contact = friction_constants(friction, cold_viscosity);
  double age = 0.0;
  for (int i = 0; i < 20000; ++i) age = aged(contact, age, 0.0, 1e-4);
  EXPECT_NEAR(age, 1.0 - std::exp(-1.0), 1e-6);
  for (int i = 0; i < 1000; ++i) age = aged(contact, age, 3e-8, 1e-5);  // 30 micrometres in 10 ms
  EXPECT_NEAR(age, (1.0 - std::exp(-1.0)) * std::exp(-1.0), 5e-3);
}

TEST(RigFriction, PreSlidingAloneDoesNotRenewTheContact) {
  FrictionState state;
  EXPECT_EQ(slip_m(plain(), state, 1e-6, 4.0), 0.0);
  EXPECT_NEAR(slip_m(plain(), state, 1e-3, 4.0), 1e-3 - 0.4 * 4.0 / (0.25 * Friction{}.contact_stiffness_N_per_m),
              1e-12);
}

TEST(RigFriction, GrowsWithLoadWearAndOilThickness) {
  const Friction worn{.wear_factor = 2.0};
  EXPECT_NEAR(breakaway_N(friction_constants(worn, cold_viscosity), 3.0, 0.0, 1.0),
              2.0 * breakaway_N(friction_constants({}, cold_viscosity), 3.0, 0.0, 1.0), 1e-12);
  EXPECT_GT(friction_constants({}, 75e-6).base_N, friction_constants({}, 11e-6).base_N);
}

TEST(RigFriction, SiltMultipliesTheBreakAwayAfterItsRestAndAMicrometreOrThreeWipeItOff) {
  const Friction clean{.ageing_gain = 2.0, .ageing_time_s = 2.0, .ageing_distance_m = 3e-5};
  Friction dirty = clean;
  dirty.silt_factor = 2.2;
  dirty.silt_rest_s = 3.0;
  const FrictionConstants without = friction_constants(clean, cold_viscosity);
  const FrictionConstants with = friction_constants(dirty, cold_viscosity);
  const auto times_at = [&](double age) {
    return breakaway_N(with, 1.0, age, 0.0) / breakaway_N(without, 1.0, age, 0.0);
  };
  double age = 0.0;
  EXPECT_EQ(times_at(age), 1.0);
  for (int i = 0; i < 10000; ++i) age = aged(with, age, 0.0, 1e-4);
  EXPECT_EQ(times_at(age), 1.0);  // 1 s
  for (int i = 0; i < 20000; ++i) age = aged(with, age, 0.0, 1e-4);
  EXPECT_NEAR(times_at(age), 2.2, 1e-3);  // 3 s
  for (int i = 0; i < 100; ++i) age = aged(with, age, 3.5e-8, 1e-6);
  EXPECT_EQ(times_at(age), 1.0);
}

TEST(RigFriction, SlidingFrictionFallsToItsShareBetweenTwoSpeeds) {
  const Friction film{.stiction_ratio = 1.0,
                      .ageing_gain = 0.0,
                      .falls_to = 0.6,
                      .falls_from_m_per_s = 1e-4,
                      .falls_until_m_per_s = 5e-4};
  const FrictionConstants contact = friction_constants(film, cold_viscosity);
  const double slow_N = breakaway_N(contact, 2.0, 0.0, 0.5e-4);
  EXPECT_EQ(breakaway_N(contact, 2.0, 0.0, -1e-4), slow_N);
  EXPECT_NEAR(breakaway_N(contact, 2.0, 0.0, -3e-4), 0.8 * slow_N, 1e-9);
  EXPECT_NEAR(breakaway_N(contact, 2.0, 0.0, 5e-4), 0.6 * slow_N, 1e-9);
  EXPECT_NEAR(breakaway_N(contact, 2.0, 0.0, 0.1), 0.6 * slow_N, 1e-9);
}

}  // namespace
}  // namespace spoolflow::rig
