#include "spoolflow/monitor/isolation.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::monitor {
namespace {

/// Windows that determine every magnitude to 0.1 of a usual fault, of a valve with these.
Evidence shown_by(const Magnitudes& truth, double deviation = 0.1) {
  Evidence out;
  for (std::size_t k = 0; k < magnitudes; ++k) {
    out.information[k * magnitudes + k] = 1 / (deviation * deviation);
    out.pull[k] = truth[k] / (deviation * deviation);
  }
  return out;
}

Isolation isolated(const Magnitudes& truth) {
  return isolate(shown_by(truth), {}, healthy_spread);
}

bool only(const Isolation& found, Fault fault) {
  for (std::size_t f = 0; f < isolated_faults; ++f) {
    if (found.likeliest[f] != (f == static_cast<std::size_t>(fault))) return false;
  }
  return found.odds[static_cast<std::size_t>(fault)] > 10;
}

TEST(Isolation, NothingSeenIsNoFault) {
  const Isolation found = isolate({}, {}, healthy_spread);
  for (const double odds : found.odds) EXPECT_LT(odds, 0.2);
  EXPECT_EQ(found.gain, 0);
}

TEST(Isolation, WhatHealthyValvesDifferByIsNoFault) {
  const Isolation found = isolated({0.15, -0.1, 0.1, -0.15, 0.1, 0.15});
  for (const bool there : found.likeliest) EXPECT_FALSE(there);
}

TEST(Isolation, EachFaultIsNamedByItsOwnMagnitude) {
  EXPECT_TRUE(only(isolated({1, 0, 0, 0, 0, 0}), Fault::friction));
  EXPECT_TRUE(only(isolated({0, 1, 0, 0, 0, 0}), Fault::edge_wear));
  EXPECT_TRUE(only(isolated({0, 0, 1, 1, 0, 0}), Fault::spring));
  EXPECT_TRUE(only(isolated({0, 0, 0, 0, 1, 0}), Fault::coil));
  EXPECT_TRUE(only(isolated({0, 0, 0, 0, 0, 1}), Fault::position_sensor));
  EXPECT_TRUE(only(isolated({0, 0, 0, 0, 0, -1}), Fault::position_sensor));
}

TEST(Isolation, AWornValveHasMoreFrictionAndRoundedEdges) {
  const Isolation found = isolated({1.2, 0.8, 0, 0, 0, 0});
  EXPECT_TRUE(found.likeliest[static_cast<std::size_t>(Fault::friction)]);
  EXPECT_TRUE(found.likeliest[static_cast<std::size_t>(Fault::edge_wear)]);
  EXPECT_NEAR(found.value[index(Magnitude::edge_rounding)], 0.8, 0.05);
}

TEST(Isolation, NothingWearsBackwards) {
  // Friction that falls, edges that sharpen, springs that gain and turns that come back are no wear.
  for (const Magnitudes& truth : {Magnitudes{-1, 0, 0, 0, 0, 0}, Magnitudes{0, -1, 0, 0, 0, 0},
                                  Magnitudes{0, 0, -1, -1, 0, 0}, Magnitudes{0, 0, 0, 0, -1, 0}}) {
    const Isolation found = isolated(truth);
    for (std::size_t f = 0; f + 1 < isolated_faults; ++f) EXPECT_FALSE(found.likeliest[f]) << f;
  }
}

TEST(Isolation, ABaselineIsWhereTheValveWas) {
  const Magnitudes before{0.6, 0, 0, 0, 0, 0.5};
  const Isolation found = isolate(shown_by(before), before, healthy_spread);
  for (const bool there : found.likeliest) EXPECT_FALSE(there);
}

TEST(Score, IsTheMagnitudeWithTheOthersHealthy) {
  const Score found = score(shown_by({0, 0.7, 0, 0, 0, 0}), {}, healthy_spread, Fault::edge_wear);
  EXPECT_NEAR(found.value, 0.7, 1e-9);
  EXPECT_NEAR(found.deviation, 0.1, 1e-9);
  EXPECT_TRUE(std::isinf(score({}, {}, healthy_spread, Fault::coil).deviation));
}

}  // namespace
}  // namespace spoolflow::monitor
