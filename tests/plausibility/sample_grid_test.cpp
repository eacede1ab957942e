/// Recordings of slower recorders that were resampled, and currents in coarse steps.
#include "spoolflow/plausibility/signals/sample_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/plausibility/channel_findings.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "tests/plausibility/example_campaign.hpp"
#include "tests/plausibility/finding_texts.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

SampleGrid grid_of(const Recording& run) {
  SampleGrid out;
  out.take(run.columns);
  return out;
}

/// Position, current and voltage as a recorder has them that keeps every so many samples.
Recording resampled(Recording run, std::size_t samples, bool held) {
  for (const Channel channel : {Channel::position, Channel::current, Channel::voltage}) {
    std::vector<double>& values = run.column(channel);
    const std::vector<double> sound = values;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t begin = k / samples * samples, end = std::min(begin + samples, values.size() - 1);
      const double share = held ? 0 : static_cast<double>(k - begin) / static_cast<double>(samples);
      values[k] = sound[begin] + share * (sound[end] - sound[begin]);
    }
  }
  return run;
}

/// Of all channels in steps of `step` [SI].
Recording in_steps(Recording run, Channel channel, double step) {
  for (double& value : run.column(channel)) value = step * std::round(value / step);
  return run;
}

TEST(SampleGrid, OfSoundRecordingsSaysNothing) {
  for (const auto& [file, recording] : example().recordings) {
    EXPECT_THAT(grid_of(recording).resampled(), IsEmpty()) << file;
    EXPECT_THAT(grid_of(recording).coarse_current(), IsEmpty()) << file;
  }
}

TEST(Resampled, IsNamedWithTheSlowerRecordersRateAndNothingElseIsBlamed) {
  const std::vector<KnownValve> known{known_valve(example().benches())};
  for (const std::size_t samples : {10U, 20U, 50U}) {
    for (const bool held : {true, false}) {
      const std::string found = all_texts(run_findings(known, means_of(resampled(ramp(), samples, held)), "run.h5"));
      EXPECT_THAT(found, AllOf(HasSubstr(fmt::format("{} samples, as of a recorder of some {} Hz resampled to 1000 Hz",
                                                     samples, 1000 / samples)),
                               HasSubstr(held ? "is held for" : "lies on a straight line over"),
                               Not(HasSubstr("shakes")), Not(HasSubstr("beats")), Not(HasSubstr("looks"))))
          << samples;
    }
  }
}

TEST(Resampled, IsNamedOfAnyRatioOfRates) {
  Recording run = ramp();
  for (const Channel channel : {Channel::position, Channel::current}) {
    std::vector<double>& values = run.column(channel);
    const std::vector<double> sound = values;
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = sound[static_cast<std::size_t>(std::floor(std::floor(static_cast<double>(k) * 0.06) / 0.06))];
  }
  EXPECT_THAT(grid_of(run).resampled(), HasSubstr("held for 17 samples, as of a recorder of some 59 Hz"));
}

/// A current that a dither of 125 Hz moves by a few steps of its recorder repeats each value for half a period.
TEST(Resampled, IsNoneOfCoarseChannelsUnderDither) {
  Recording run;
  for (int k = 0; k < 40'000; ++k) {
    run.column(Channel::time).push_back(1e-3 * k);
    run.column(Channel::current).push_back(1 + (k / 4 % 2 == 0 ? 0.02 : 0.0));
    run.column(Channel::position).push_back(1e-3 + (k / 4 % 2 == 0 ? 1e-5 : 0.0));
  }
  EXPECT_THAT(grid_of(run).resampled(), IsEmpty());
}

TEST(CoarseCurrent, IsNamedWithItsStepInARunAndInACampaign) {
  for (const double step_A : {0.02, 0.04, 0.08}) {
    const Recording coarse = in_steps(ramp(), Channel::current, step_A);
    EXPECT_THAT(grid_of(coarse).coarse_current(),
                HasSubstr(fmt::format("current comes in steps of {:.2g} mA", 1e3 * step_A)));
    EXPECT_THAT(all_texts(channel_findings({&coarse})), HasSubstr("ramp_60bar.h5: current comes in steps of"));
  }
  EXPECT_THAT(grid_of(in_steps(ramp(), Channel::current, 0.005)).coarse_current(), IsEmpty());
}

/// A ramp of 40 mA from one sample to the next.
TEST(CoarseCurrent, IsNoneOfAHandfulOfSamples) {
  Recording run;
  for (int k = 0; k < 5; ++k) {
    run.column(Channel::time).push_back(1e-3 * k);
    run.column(Channel::current).push_back(0.5 + 0.04 * k);
    run.column(Channel::position).push_back(0);
  }
  EXPECT_THAT(grid_of(run).coarse_current(), IsEmpty());
}

/// The noise of an idle coil is few steps high.
TEST(CoarseCurrent, IsNoneOfAnIdleCoilBesideTheOther) {
  Recording run;
  for (int k = 0; k < 10'000; ++k) {
    run.column(Channel::time).push_back(1e-3 * k);
    run.column(Channel::current_b).push_back(1e-3 * (k % 1500));
    run.column(Channel::current_a).push_back(1e-3 * (k % 2));
  }
  EXPECT_THAT(grid_of(run).coarse_current(), IsEmpty());
}

}  // namespace
}  // namespace spoolflow::plausibility
