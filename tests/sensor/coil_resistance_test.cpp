#include "spoolflow/sensor/coil_resistance.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/sensor/actuator.hpp"

namespace {

using spoolflow::sensor::ActuatorParameters;
using spoolflow::sensor::ActuatorState;
using spoolflow::sensor::CoilEquation;
using spoolflow::sensor::CoilResistance;
using spoolflow::sensor::CoilResistanceState;
using spoolflow::sensor::collect;
using spoolflow::sensor::follow_coil;
using spoolflow::sensor::follow_resistance;
using spoolflow::sensor::judge_answer;
using spoolflow::sensor::Sample;
using spoolflow::sensor::take_up;

constexpr CoilResistance<double> coil{
    .resistance_Ohm = 10, .uncertainty_Ohm = 2, .drift_Ohm_per_root_s = 0.02, .voltage_noise_V_root_s = 0.01};

constexpr double sampled_every_s = 1e-3;
constexpr double least_A = 0.04;

/// One sample, in the mean and in the filter.
void follow(CoilResistanceState<double>& state, const CoilEquation<double>& sample) {
  collect(state, sample, sampled_every_s);
  follow_resistance(coil, state, {take_up(state), least_A});
}

/// Ten seconds at 1 ms and 0.8 A of a coil that has `resistance_Ohm`.
CoilResistanceState<double> followed(double resistance_Ohm, double current_A = 0.8) {
  CoilResistanceState<double> state;
  for (int n = 0; n < 10000; ++n) follow(state, {current_A, resistance_Ohm * current_A, 0.0});
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
  for (int n = 0; n < 1000; ++n) follow(state, {0, 0, 0});
  for (const double flux_rate_V : {20.0, 14.0, 8.0, 4.0, 2.0, 1.0, 0.5}) {
    const double current_A = 0.5 - 0.02 * flux_rate_V;
    follow(state, {current_A, 10 * current_A + 1.4 * flux_rate_V, flux_rate_V});
    EXPECT_FALSE(state.implausible) << flux_rate_V;
    EXPECT_NEAR(state.resistance_Ohm, 10, 3) << flux_rate_V;
  }
}

TEST(CoilResistance, IsFollowedUnderStrongDitherWhoseFluxRateIsUncertain) {
  // 200 Hz at 1 kHz: a sensor that takes every fifth sample only always meets the same phase.
  for (const double phase : {0.0, 0.3, 0.6, 0.9}) {
    CoilResistanceState<double> state;
    for (int n = 0; n < 20000; ++n) {
      const double angle = 2 * std::numbers::pi * (0.2 * n + phase);
      const double current_A = 0.8 + 0.25 * std::sin(angle);
      const double flux_rate_V = 12 * std::cos(angle);
      collect(state, {current_A, 10 * current_A + flux_rate_V, 0.7 * flux_rate_V}, sampled_every_s);
      if (n % 5 == 0) follow_resistance(coil, state, {take_up(state), least_A});
    }
    EXPECT_FALSE(state.implausible) << phase;
    EXPECT_NEAR(state.resistance_Ohm, 10, 0.5) << phase;
  }
}

TEST(CoilResistance, WithoutCurrentOrVoltageNothingIsSaid) {
  EXPECT_FALSE(followed(5, 0).implausible);
  CoilResistanceState<double> state;
  follow(state, {0.8, 8.0, 0.0});
  const double voltage_V = state.mean.voltage_V;
  for (int n = 0; n < 10000; ++n) collect(state, {0.8, std::numeric_limits<double>::quiet_NaN(), 0.0}, sampled_every_s);
  take_up(state);
  EXPECT_FALSE(state.implausible);
  EXPECT_EQ(state.mean.voltage_V, voltage_V);
}

/// Whether no current answers the voltage, `after_s` after the current's instrument broke; 0.4 V are quiet.
bool unanswered(double after_s) {
  CoilResistanceState<double> state = followed(10);
  for (int n = 0; n < std::lround(after_s / sampled_every_s); ++n) collect(state, {0, 8, 0}, sampled_every_s);
  take_up(state);
  judge_answer(coil, state, 0.4);
  return state.unanswered;
}

TEST(CoilResistance, RestsThatLeaveTheZeroOfTheInstrumentsAloneAreNoFault) {
  CoilResistanceState<double> state = followed(11);
  for (int n = 0; n < 600000; ++n) follow(state, {0.5 * least_A, 0.01, 0.0});
  EXPECT_FALSE(state.implausible);
  EXPECT_NEAR(state.resistance_Ohm, 11, 0.2);
  for (int n = 0; n < 10000; ++n) follow(state, {0.8, 0.8 * 9, 0.0});
  EXPECT_NEAR(state.resistance_Ohm, 9, 0.2);  // it has cooled meanwhile
}

TEST(CoilResistance, AVoltageThatNoCurrentAnswersIsAFaultWithinFiveHundredthsOfASecond) {
  EXPECT_FALSE(unanswered(0));
  EXPECT_TRUE(unanswered(0.05));
  EXPECT_TRUE(unanswered(1));
}

TEST(CoilResistance, AVoltageThatAFluxAnswersIsNoFault) {
  CoilResistanceState<double> state;
  collect(state, {0, 24, 18}, 1.0);  // in one step all of the mean; a third of the flux rate may be wrong
  take_up(state);
  judge_answer(coil, state, 0.4);
  EXPECT_FALSE(state.unanswered);
  collect(state, {0, 24, 6}, 1.0);
  take_up(state);
  judge_answer(coil, state, 0.4);
  EXPECT_TRUE(state.unanswered);
}

TEST(CoilResistance, GrowsAsUncertainAndLearnsAsMuchHoweverSeldomItIsFollowed) {
  ActuatorParameters<double> actuator{};
  actuator.coil_resistance = coil;
  for (const double current_A : {0.0, 0.05}) {
    const Sample<double> sample{sampled_every_s, current_A, 11 * current_A, 1e-3, 320.0};
    const auto followed_every = [&](int samples) {
      ActuatorState<double> state{};
      for (int n = 1; n <= 10000; ++n) follow_coil(actuator, state, sample, 2.0, {n % samples == 0, 0.0});
      return state.coil_resistance;
    };
    const auto always = followed_every(1), seldom = followed_every(20);
    EXPECT_NEAR(seldom.variance_Ohm2, always.variance_Ohm2, 0.01 * always.variance_Ohm2) << current_A;
    EXPECT_NEAR(seldom.resistance_Ohm, always.resistance_Ohm, 0.01) << current_A;
  }
}

TEST(CoilResistance, OfACoilWithoutVoltageIsLeftAlone) {
  ActuatorParameters<double> actuator{};
  actuator.coil_resistance = coil;
  ActuatorState<double> state{};
  Sample<double> sample{sampled_every_s, 0.8, std::numeric_limits<double>::quiet_NaN(), 1e-3, 320.0};
  follow_coil(actuator, state, sample, 2.0, {true, 0.0});
  EXPECT_EQ(state.coil_resistance.variance_Ohm2, 0);
  sample.voltage_V = 8;
  follow_coil(actuator, state, sample, 2.0, {true, 0.0});
  EXPECT_GT(state.coil_resistance.variance_Ohm2, 0);
}

}  // namespace
