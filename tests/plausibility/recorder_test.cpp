/// What amplifiers and recorders do to a channel: clipped ends, and clocks that differ. Of sound recordings, and of
/// signals that stand at an end by themselves, nothing is said.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/plausibility/channel_findings.hpp"
#include "spoolflow/plausibility/clipped_channel.hpp"
#include "spoolflow/plausibility/motion_delay.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/plausibility/example_campaign.hpp"
#include "tests/plausibility/finding_texts.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// The value below which a share of the samples lies.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

TEST(ClippedChannel, IsNamedInAnyBenchTestOrRun) {
  const std::vector<std::pair<std::string, Channel>> channels{{"spring.h5", Channel::axial_force},
                                                              {"solenoid_map.h5", Channel::force},
                                                              {"solenoid_dynamic.h5", Channel::current},
                                                              {"axial_force_map_50.h5", Channel::axial_force},
                                                              {"axial_force_map_50.h5", Channel::pressure_upstream},
                                                              {"axial_force_map_50.h5", Channel::flow},
                                                              {"ramp_60bar.h5", Channel::current},
                                                              {"ramp_60bar.h5", Channel::position}};
  for (const auto& [file, channel] : channels) {
    Recording clipped = example().recordings.at(file);
    const double end = quantile(clipped.column(channel), 0.95);
    for (double& value : clipped.column(channel)) value = std::min(value, end);
    EXPECT_THAT(all_texts(channel_findings({&clipped})),
                testing::HasSubstr(fmt::format("{}: {} stands at its highest value", file, recording::name(channel))));
  }
}

TEST(ClippedChannel, IsNamedAtItsLowestValueAsWell) {
  Recording run = duty_cycle();
  std::vector<double>& position_m = run.column(Channel::position);
  const double end = quantile(position_m, 0.02);
  for (double& value : position_m) value = std::max(value, end);
  EXPECT_THAT(all_texts(channel_findings({&run})), testing::HasSubstr("position stands at its lowest value"));
}

TEST(ClippedChannel, IsNoneThatStandsAtItsEndByItself) {
  std::vector<double> noise_free, off, coarse;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 1e-3);
  for (int k = 0; k < 20'000; ++k) {
    const double ramp = std::abs(k % 4000 - 2000) / 2000.0;
    noise_free.push_back(std::min(ramp, 0.8));                 // rests at its stop
    off.push_back(std::max(ramp - 0.5 + noise(random), 0.0));  // a pump that is off, of a one-sided converter
    coarse.push_back(0.01 * std::round(100 * std::min(ramp, 0.8) + 0.1));  // steps that hide the noise
  }
  for (const std::vector<double>& signal : {noise_free, off, coarse}) {
    Recording run;
    run.column(Channel::pressure_upstream) = signal;
    ClippedChannels clipped;
    clipped.take(run.columns);
    EXPECT_THAT(clipped.findings(), testing::IsEmpty());
  }
}

TEST(ClippedChannel, IsAMarkerOfMissingValuesWhereItStandsAtNines) {
  for (const auto& [channel, marker] : {std::pair{Channel::position, -0.999}, std::pair{Channel::current, 9999.0}}) {
    Recording marked = example().recordings.at("ramp_60bar.h5");
    for (std::size_t k = 0; k < marked.size(); k += 1000)
      std::fill_n(marked.column(channel).begin() + static_cast<std::ptrdiff_t>(k),
                  std::min<std::size_t>(3, marked.size() - k), marker);
    EXPECT_THAT(all_texts(channel_findings({&marked})), testing::AllOf(testing::HasSubstr("a marker of missing values"),
                                                                       testing::Not(testing::HasSubstr("clips"))));
    const std::vector<KnownValve> known{known_valve(example().benches())};
    EXPECT_THAT(
        all_texts(run_findings(known, means_of(marked), "run.h5")),
        testing::MatchesRegex("run.h5: (position is -999 mm|current is 9999 A) for .* a marker of missing [^\n]*\n"));
  }
}

Recording position_late(Recording run, double late_s) {
  shift_by(run, late_s, Channel::position);
  return run;
}
std::optional<double> delay_of(const Recording& run) {
  MotionTrace motion;
  motion.take(run.columns);
  return motion_delay_s(motion);
}

TEST(MotionDelay, IsFoundBesideWhatASpoolTakes) {
  EXPECT_EQ(delay_of(duty_cycle()), std::nullopt);
  for (const double late_s : {-2.0, -0.2, 0.2, 2.0}) {
    const std::optional<double> found_s = delay_of(position_late(duty_cycle(), late_s));
    ASSERT_TRUE(found_s) << late_s;
    EXPECT_NEAR(*found_s, late_s + 0.04, 0.03);  // a spool of this valve follows its current within 10 to 70 ms
  }
}

TEST(MotionDelay, IsFoundOfAWholeValveWhoseCoilsMoveItEitherWay) {
  Recording both = duty_cycle();
  const std::vector<double> current_A = both.column(Channel::current);
  both.column(Channel::current).clear();
  for (const double each_A : current_A) {
    both.column(Channel::current_b).push_back(0.5 + each_A / 2);
    both.column(Channel::current_a).push_back(0.5 - each_A / 2);
  }
  EXPECT_EQ(delay_of(both), std::nullopt);
  EXPECT_TRUE(delay_of(position_late(both, 0.2)));
}

TEST(MotionDelay, IsNoneOfSlowStrokesWhereFrictionTurnsTheCurrentLongBeforeTheSpool) {
  const Recording& ramp = example().recordings.at("ramp_60bar.h5");
  for (const double late_s : {0.0, 0.5}) EXPECT_EQ(delay_of(position_late(ramp, late_s)), std::nullopt);
}

/// Triangles, each of which the current begins some time before the spool.
TEST(MotionDelay, IsNoneOfTrianglesBehindFrictionHoweverAlikeTheyAre) {
  Recording run;
  for (int k = 0; k < 90'000; ++k) {
    const double time_s = 1e-3 * k, period_s = 5;
    const auto triangle = [&](double at_s) { return std::abs(std::remainder(at_s, period_s)) / period_s; };
    run.column(Channel::time).push_back(time_s);
    run.column(Channel::position).push_back(2e-3 * triangle(time_s - 0.3));
    run.column(Channel::current).push_back(1.5 * triangle(time_s));
  }
  EXPECT_EQ(delay_of(run), std::nullopt);
}

/// A supply steps every 3 s: the resting spool gives way by micrometres, and the position control answers.
TEST(MotionDelay, IsNoneOfStepsOfARestingSpoolThatFitByChance) {
  constexpr std::array<int, 5> way{1, -1, -1, 1, -1};
  Recording run;
  double position_m = 1e-3, current_A = 1;
  for (std::size_t k = 0; k < 90'000; ++k) {
    if (k % 3000 == 0) {
      position_m += 2e-6 * way[k / 3000 % way.size()];
      current_A += 0.05 * way[(k / 3000 + 1) % way.size()];
    }
    run.column(Channel::time).push_back(1e-3 * static_cast<double>(k));
    run.column(Channel::position).push_back(position_m);
    run.column(Channel::current).push_back(current_A);
  }
  EXPECT_EQ(delay_of(run), std::nullopt);
}

TEST(MotionDelay, IsSaidOfARunInACampaign) {
  Recording late = position_late(duty_cycle(), 0.3);
  late.file = "duty.h5";
  EXPECT_THAT(all_texts(channel_findings({&late})),
              testing::MatchesRegex("duty.h5: position comes 0.3. s late against current.*\n"));
  Recording early = position_late(duty_cycle(), -0.3);
  early.file = "duty.h5";
  EXPECT_THAT(all_texts(channel_findings({&early})),
              testing::MatchesRegex("duty.h5: current comes 0.2. s late against position.*\n"));
}

}  // namespace
}  // namespace spoolflow::plausibility
