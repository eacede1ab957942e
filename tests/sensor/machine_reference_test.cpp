/// References taken one at a time, in the valve's own precision.
#include "spoolflow/sensor/machine_reference.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::sensor {
namespace {

constexpr float stroke_m3 = 2.6e-3F;

MachineKnowledge<float> boom() {
  MachineKnowledge<float> out;
  out.rated_flow_m3_per_s = 80.0F / 60000.0F;
  out.leakage_m3_per_s = 0.1F / 60000.0F;
  return out;
}

struct Machine {
  float sensor_share = 1;  ///< the sensor's volume over what passes
  float leak_L_min = 0;
  float consumer_L_min = 0;  ///< in each third stroke
  float stated = 1;          ///< volume over the true one
};

/// Strokes of 3 to 12 s, as a sensor sees them that is off by 1.5 % here and there.
ReferenceState<float> after(int strokes, const Machine& machine, ReferenceState<float> state = {}) {
  for (int k = 0; k < strokes; ++k) {
    const float seconds = 3.0F + 0.5F * static_cast<float>(7 * k % 19), off = (k % 2 == 0 ? 0.015F : -0.015F);
    const float beside = machine.leak_L_min + (k % 3 == 1 ? machine.consumer_L_min : 0);
    const float passed_m3 = stroke_m3 + beside / 60000.0F * seconds;
    static_cast<void>(update(
        boom(), state, {machine.stated * stroke_m3, 2e-6F, {machine.sensor_share * passed_m3 * (1 + off), seconds}}));
  }
  return state;
}

TEST(MachineReference, TwentyStrokesFindHowMuchWiderTheEdgesAre) {
  for (const float width : {0.1F, 0.15F, 0.2F}) {
    const auto found = finding_of(boom(), after(20, {1 / std::sqrt(1 + width)}));
    EXPECT_EQ(found.verdict, MachineVerdict::moves);
    EXPECT_NEAR(found.edge_width, width, 2 * found.edge_width_deviation);
    EXPECT_LT(found.edge_width_deviation, 0.032F);
  }
}

TEST(MachineReference, AHealthyValveStaysAsItIsForAYearOfStrokes) {
  const ReferenceState<float> state = after(5000, {});
  EXPECT_EQ(finding_of(boom(), state).verdict, MachineVerdict::stays);
  EXPECT_NEAR(state.level, 0, 0.005F);
  EXPECT_EQ(finding_of(boom(), ReferenceState<float>{}).verdict, MachineVerdict::too_few);
}

TEST(MachineReference, AnAreaThatIsWrongByTwoPercentMovesNothing) {
  EXPECT_EQ(finding_of(boom(), after(20, {1, 0, 0, 1.02F})).verdict, MachineVerdict::stays);
  EXPECT_EQ(finding_of(boom(), after(20, {1, 0, 0, 0.98F})).verdict, MachineVerdict::stays);
  EXPECT_EQ(finding_of(boom(), after(20, {1, 0, 0, 0.93F})).verdict, MachineVerdict::less_oil);
}

TEST(MachineReference, AnAreaThatIsWrongByFifteenPercentIsNoWear) {
  EXPECT_EQ(finding_of(boom(), after(20, {1, 0, 0, 1.15F})).verdict, MachineVerdict::more_oil);
}

TEST(MachineReference, ALeakingSealIsToldFromWiderEdgesBySlowStrokes) {
  const auto found = finding_of(boom(), after(40, {1, 2}));
  EXPECT_EQ(found.verdict, MachineVerdict::leaks);
  EXPECT_NEAR(found.leakage_m3_per_s, 2.0F / 60000.0F, 1.0F / 60000.0F);
}

TEST(MachineReference, AnotherConsumerLiesApartAndTooManyAreContradicted) {
  ReferenceState<float> state = after(20, {});
  const PassedVolume<float> with_another{1.2F * stroke_m3, 6};
  EXPECT_EQ(update(boom(), state, {stroke_m3, 2e-6F, with_another}), ReferenceVerdict::apart);
  EXPECT_EQ(finding_of(boom(), state).verdict, MachineVerdict::stays);
  for (int k = 0; k < 20; ++k) static_cast<void>(update(boom(), state, {stroke_m3, 2e-6F, with_another}));
  EXPECT_EQ(finding_of(boom(), state).verdict, MachineVerdict::apart);
}

TEST(MachineReference, WhatIsNoReferenceChangesNothing) {
  const ReferenceState<float> before = after(20, {});
  ReferenceState<float> state = before;
  for (const float known_m3 : {0.0F, -1.0F, NAN, INFINITY})
    EXPECT_EQ(update(boom(), state, {known_m3, 2e-6F, {stroke_m3, 6}}), ReferenceVerdict::not_seen);
  for (const float seen_m3 : {0.0F, 0.2F * stroke_m3, NAN, 4 * stroke_m3})
    EXPECT_EQ(update(boom(), state, {stroke_m3, 2e-6F, {seen_m3, 6}}), ReferenceVerdict::not_seen);
  EXPECT_EQ(update_closed(boom(), state, NAN), ReferenceVerdict::not_seen);
  EXPECT_EQ(state.level, before.level);
  EXPECT_EQ(state.taken, before.taken);
}

TEST(MachineReference, PositionZeroIsWhereTheClosedSpoolReads) {
  ReferenceState<float> state;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(update_closed(boom(), state, 16e-6F), ReferenceVerdict::taken);
  const auto found = finding_of(boom(), state);
  EXPECT_EQ(found.verdict, MachineVerdict::moves);
  EXPECT_NEAR(found.position_zero_m, 16e-6F, 1e-7F);
  EXPECT_EQ(found.edge_width, 0);
}

TEST(MachineReference, FollowsWearThatGoesOn) {
  ReferenceState<float> state = after(2000, {});
  state = after(300, {0.96F}, state);
  EXPECT_NEAR(state.level, -std::log(0.96F), 0.01F);
}

TEST(MachineReference, LogarithmNeedsNoLibrary) {
  for (float value = 0.3F; value < 3.3F; value *= 1.07F) EXPECT_NEAR(detail::logarithm(value), std::log(value), 3e-4F);
}

}  // namespace
}  // namespace spoolflow::sensor
