/// What is reported beside the magnitudes: trends, steps of the command, dither, the contacts.
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "spoolflow/monitor/command_response.hpp"
#include "spoolflow/monitor/contact_reading.hpp"
#include "spoolflow/monitor/dither_health.hpp"
#include "spoolflow/monitor/trend.hpp"
#include "tests/monitor/example.hpp"

namespace spoolflow::monitor {
namespace {

Course course_of(double per_hour, int windows, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise(0, 0.1);
  Course out;
  for (int k = 0; k < windows; ++k) {
    const double time_h = 0.01 * k;
    follow(out, time_h, per_hour * time_h + noise(generator));
  }
  return out;
}

TEST(Trend, AValveThatDoesNotChangeHasNone) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    EXPECT_FALSE(line_through(course_of(0, 300, seed), 0.2).there) << seed;
  }
}

TEST(Trend, ASteadyGrowthReachesItsLimitWhenTheLineSaysSo) {
  int holds = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Line line = line_through(course_of(0.4, 300, seed), 0.2);
    ASSERT_TRUE(line.there) << seed;
    const TimeToLimit time = time_to(line, 2);
    EXPECT_NEAR(time.expected_h, 2.0, 0.4);
    holds += time.earliest_h <= 2.01 && time.latest_h >= 2.01 ? 1 : 0;
  }
  EXPECT_GE(holds, 40);
}

TEST(Trend, AShrinkingMagnitudeNeverReachesAnUpperLimit) {
  const TimeToLimit time = time_to({true, 1, 0.01, -0.1, 0.01}, 2);
  EXPECT_TRUE(std::isinf(time.expected_h));
  EXPECT_EQ(time_to({true, -3, 0.01, -0.1, 0.01}, -2).expected_h, 0);
}

/// A second-order valve answers a step of the command.
CommandResponse stepped(double damping) {
  CommandResponse state;
  constexpr double stroke_m = 2.4e-3, step_s = 1e-3, own_1_s = 200;
  double position_m = 0, velocity_m_per_s = 0;
  for (int k = 0; k < 2000; ++k) {
    const double command_m = k < 500 ? 0 : 0.5 * stroke_m;
    const double acceleration = own_1_s * own_1_s * (command_m - position_m) - 2 * damping * own_1_s * velocity_m_per_s;
    velocity_m_per_s += acceleration * step_s;
    position_m += velocity_m_per_s * step_s;
    follow(state, stroke_m, {step_s, command_m, position_m});
  }
  return state;
}

TEST(CommandResponse, OvershootIsThatOfItsDamping) {
  const CommandResponse light = stepped(0.4);
  ASSERT_EQ(light.steps, 1);
  EXPECT_NEAR(light.overshoot, std::exp(-0.4 * std::numbers::pi / std::sqrt(1 - 0.16)), 0.05);
  EXPECT_NEAR(light.response_s, 0.010, 0.002);
  EXPECT_LT(stepped(1).overshoot, 1e-3);
  EXPECT_GT(stepped(1).response_s, light.response_s);
}

TEST(CommandResponse, ASlowRampIsNoStep) {
  CommandResponse state;
  for (int k = 0; k < 5000; ++k) follow(state, 2.4e-3, {1e-3, 2.4e-7 * k, 2.4e-7 * k});
  EXPECT_EQ(state.steps, 0);
}

TEST(Dither, AmplitudeAndFrequencyAreThoseOfTheCurrent) {
  DitherHealth health;
  for (int k = 0; k < 20000; ++k) {
    const double time_s = 1e-4 * k;
    follow(health, 2.6, {1e-4, 1.2 + 0.1 * std::sin(2 * std::numbers::pi * 120 * time_s), k % 4 != 0});
  }
  EXPECT_NEAR(health.amplitude_A, 0.1, 0.005);
  EXPECT_NEAR(health.frequency_Hz, 120, 3);
  EXPECT_NEAR(health.free_share, 0.75, 0.01);
  DitherHealth still;
  for (int k = 0; k < 20000; ++k) follow(still, 2.6, {1e-4, 1.2, false});
  EXPECT_EQ(still.dithered_s, 0);
}

/// Break-aways both ways over the stroke; friction is `ratio(share of the stroke)` times the model's.
template <class Ratio>
WindowState window_of(const Ratio& ratio, double off_N) {
  WindowState out;
  const double stroke_m = example().valve.stroke_m;
  for (int k = 0; k < 40; ++k) {
    const double share = 0.05 + 0.8 * (k % 20) / 20.0;
    ForceEvent event{.time_s = 0.5 * k,
                     .position_m = share * stroke_m,
                     .net_force_N = 0,
                     .rested_s = 0.2,
                     .friction_N = 0,
                     .current_A = 1.2,
                     .oil_temperature_K = 323,
                     .pressure_difference_Pa = 50e5,
                     .direction = k < 20 ? 1.0 : -1.0,
                     .count = 1,
                     .kind = EventKind::breakaway};
    const auto& valve = example().observer->parameters;
    const Explained healthy = explain(valve, stroke_m, event, 50e5);
    event.net_force_N =
        -healthy.residual_N + off_N +
        event.direction * (ratio(share) - 1) * valve.friction.operation_ratio * healthy.friction_limit_N;
    out.events[out.count++] = event;
  }
  return out;
}

ContactReading read(const WindowState& window) {
  return read_contacts(example().observer->parameters, example().valve.stroke_m, window, 50e5);
}

TEST(Contacts, FrictionIsFoundWhereItGrows) {
  const ContactReading reading = read(window_of([](double share) { return share < 0.3 ? 1.6 : 1.0; }, 0));
  EXPECT_NEAR(reading.friction_ratio[0].value, 1.6, 0.1);
  EXPECT_NEAR(reading.friction_ratio[2].value, 1.0, 0.02);
  EXPECT_EQ(reading.stick_share.value, 1);
}

TEST(Contacts, AForceThatIsAlikeBothWaysIsNoFriction) {
  const ContactReading reading = read(window_of([](double) { return 1.0; }, 1.5));
  for (const Weighted& region : reading.friction_ratio) EXPECT_NEAR(region.value, 1, 0.05);
  EXPECT_NEAR(reading.breakaway_N.value, reading.breakaway_expected_N, 0.05 * reading.breakaway_expected_N);
}

TEST(Contacts, AWornSpoolBreaksAwayLate) {
  const ContactReading reading = read(window_of([](double) { return 1.5; }, 0));
  EXPECT_NEAR(reading.breakaway_N.value, 1.5 * reading.breakaway_expected_N, 0.05 * reading.breakaway_expected_N);
}

}  // namespace
}  // namespace spoolflow::monitor
