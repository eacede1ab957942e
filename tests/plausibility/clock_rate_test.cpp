#include "spoolflow/plausibility/signals/clock_rate.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plausibility/closed_form_coil.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using testing::HasSubstr;
using testing::IsEmpty;

/// Means over 10 ms, or `step_s`, of a coil at work for a minute, in which the recorder counts `seconds` for each
/// second.
recording::Recording recorded_by(double seconds, double voltage_scale = 1, double step_s = 0.01) {
  recording::Recording out;
  const auto current_A = [](double t) { return 1 + 0.4 * std::sin(1.9 * t) + 0.2 * std::sin(5.3 * t); };
  const auto position_m = [](double t) { return 1e-3 * (1 + 0.6 * std::sin(1.9 * t - 0.4)); };
  const auto flux_at = [&](double t) { return flux_Wb(current_A(t), position_m(t)); };
  for (int k = 0; k * step_s < 60; ++k) {
    const double t = step_s * k, d = 1e-4;
    out.column(Channel::time).push_back(seconds * t);
    out.column(Channel::current).push_back(current_A(t));
    out.column(Channel::position).push_back(position_m(t));
    const double voltage_V = resistance_Ohm * current_A(t) + (flux_at(t + d) - flux_at(t - d)) / (2 * d);
    out.column(Channel::voltage).push_back(voltage_scale * voltage_V);
  }
  return out;
}

TEST(ClockRate, TheInducedVoltageTellsTimeThatRunsTooFastOrSlow) {
  EXPECT_THAT(wrong_clock(recorded_by(0.5), coil), HasSubstr("time runs 1.9 times too fast: beside its resistance"));
  EXPECT_THAT(wrong_clock(recorded_by(2), coil), HasSubstr("time runs 2.0 times too slow"));
  EXPECT_THAT(wrong_clock(recorded_by(2, 1, 0.064), coil), HasSubstr("time runs 2.0 times too slow"))
      << "as long as the means of a run of four minutes";
}

TEST(ClockRate, ACoilInItsOwnTimeRaisesNothing) {
  for (const double seconds : {0.8, 1.0, 1.2})
    EXPECT_THAT(wrong_clock(recorded_by(seconds), coil), IsEmpty()) << seconds;
}

/// A coil whose flux is a table's, with an edge's value where there is no number to look up.
KnownCoil coil_of_a_table() {
  return {resistance_Ohm, [](double current_A, double position_m) {
            return flux_Wb(std::isnan(current_A) ? 0 : current_A, std::isnan(position_m) ? 0 : position_m);
          }};
}

TEST(ClockRate, MissingValuesRaiseNothing) {
  for (const Channel channel : {Channel::current, Channel::position, Channel::voltage}) {
    recording::Recording run = recorded_by(1);
    for (int k = 1000; k < 2500; ++k) run.column(channel)[k] = NAN;
    EXPECT_THAT(wrong_clock(run, coil_of_a_table()), IsEmpty()) << recording::name(channel);
    for (double& value : run.column(channel)) value = NAN;
    EXPECT_THAT(wrong_clock(run, coil_of_a_table()), IsEmpty()) << recording::name(channel);
  }
}

TEST(ClockRate, WhatAnotherScaleMakesOfTheResistanceTooIsNoClock) {
  EXPECT_THAT(wrong_clock(recorded_by(1, 0.5), coil), IsEmpty());
  EXPECT_THAT(wrong_clock(recorded_by(1, 2), coil), IsEmpty());
}

TEST(ClockRate, WithoutAKnownCoilOrAMovingCurrentItSaysNothing) {
  EXPECT_THAT(wrong_clock(recorded_by(0.5), {}), IsEmpty());
  recording::Recording still = recorded_by(0.5);
  for (double& current_A : still.column(Channel::current)) current_A = 1;
  EXPECT_THAT(wrong_clock(still, coil), IsEmpty());
}

}  // namespace
}  // namespace spoolflow::plausibility
