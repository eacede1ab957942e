#include "spoolflow/sensor/coil_resistance.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace {

using spoolflow::sensor::CoilResistance;
using spoolflow::sensor::CoilResistanceState;
using spoolflow::sensor::follow_resistance;

constexpr CoilResistance<double> coil{
    .resistance_Ohm = 10, .uncertainty_Ohm = 2, .drift_Ohm_per_root_s = 0.02, .voltage_noise_V_root_s = 0.01};

/// Ten seconds at 1 ms and 0.8 A of a coil that has `resistance_Ohm`.
CoilResistanceState<double> followed(double resistance_Ohm, double current_A = 0.8) {
  CoilResistanceState<double> state;
  for (int n = 0; n < 10000; ++n) follow_resistance(coil, state, {1e-3, current_A, resistance_Ohm * current_A, 0.0});
  return state;
}

TEST(CoilResistance, IsFoundFromVoltageAndCurrent) {
  EXPECT_NEAR(followed(11.7).resistance_Ohm, 11.7, 0.05);
}

TEST(CoilResistance, OfAWarmCoilIsNoFault) {
  EXPECT_FALSE(followed(10 * (1 + 0.0039 * 120)).implausible);
  EXPECT_FALSE(followed(10 * (1 - 0.0039 * 60)).implausible);
}

TEST(CoilResistance, OfHalfTheTurnsOrABadContactIsAFault) {
  EXPECT_TRUE(followed(5).implausible);
  EXPECT_TRUE(followed(20).implausible);
}

TEST(CoilResistance, OfAColdStartIsNoFaultThoughTheFluxOfTheFirstMillisecondsIsModelledPoorly) {
  CoilResistanceState<double> state;
  for (int n = 0; n < 1000; ++n) follow_resistance(coil, state, {1e-3, 0, 0, 0});
  for (const double flux_rate_V : {20.0, 14.0, 8.0, 4.0, 2.0, 1.0, 0.5}) {
    const double current_A = 0.5 - 0.02 * flux_rate_V;
    follow_resistance(coil, state, {1e-3, current_A, 10 * current_A + 1.4 * flux_rate_V, flux_rate_V});
    EXPECT_FALSE(state.implausible) << flux_rate_V;
    EXPECT_NEAR(state.resistance_Ohm, 10, 3) << flux_rate_V;
  }
}

TEST(CoilResistance, WithoutCurrentOrVoltageNothingIsSaid) {
  EXPECT_FALSE(followed(5, 0).implausible);
  CoilResistanceState<double> state;
  for (int n = 0; n < 10000; ++n)
    follow_resistance(coil, state, {1e-3, 0.8, std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_FALSE(state.implausible);
  EXPECT_EQ(state.variance_Ohm2, 0);
}

}  // namespace
