/// What a coil's voltage and current say against themselves: scales that leap, zeros that are off, means that are gone.
/// Sound recordings of the example and of the rig raise nothing.
#include "spoolflow/plausibility/signals/coil_signals.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/channel_findings.hpp"
#include "spoolflow/plausibility/coil_currents.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "tests/plausibility/example_campaign.hpp"
#include "tests/plausibility/finding_texts.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Recording in_blocks(const Recording& run) {
  return block_means(run, 2500);
}
std::string findings_of(const Recording& run) {
  const std::vector<KnownValve> known{known_valve(example().benches())};
  return all_texts(run_findings(known, means_of(run), "run.h5"));
}

Recording with_current(Recording run, auto&& changed) {
  const std::size_t rows = run.size();
  for (std::size_t k = 0; k < rows; ++k) run.column(Channel::current)[k] = changed(run.column(Channel::current)[k], k);
  return run;
}

TEST(CoilSignals, OfSoundRecordingsSayNothing) {
  for (const auto& [file, recording] : example().recordings) {
    const Recording means = in_blocks(recording);
    EXPECT_THAT(resistance_leaps(means), IsEmpty()) << file;
    EXPECT_THAT(currents_without_voltage(means), IsEmpty()) << file;
    EXPECT_THAT(signed_coil_currents(means), IsEmpty()) << file;
    EXPECT_THAT(supply_voltage(means), IsEmpty()) << file;
  }
  EXPECT_THAT(resistance_leaps(in_blocks(duty_cycle())), IsEmpty());
}

TEST(ResistanceLeap, IsNamedWithItsTimeWhereTheCurrentsScaleChangesInARun) {
  for (const Recording* run : {&ramp(), &duty_cycle()}) {
    for (const double scale : {0.9, 1.05, 1.1}) {
      const std::size_t half = run->size() / 2;
      const Recording scaled =
          with_current(*run, [&](double current_A, std::size_t k) { return k < half ? current_A : scale * current_A; });
      const auto found = resistance_leaps(in_blocks(scaled));
      ASSERT_EQ(found.size(), 1U) << scale;
      EXPECT_THAT(found[0], HasSubstr("voltage over current leaps from"));
      const double at_s = std::stod(found[0].substr(found[0].find(" Ohm at ") + 8));
      EXPECT_NEAR(at_s, run->column(Channel::time)[half], 3) << scale;
      const double percent = std::stod(found[0].substr(found[0].find(" by ") + 4));
      EXPECT_NEAR(percent, 100 * (1 / scale - 1), 2) << scale;
    }
  }
}

TEST(ResistanceLeap, IsNoneOfACoilThatWarmsAsFastAsCopperCan) {
  Recording run;
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0, 1e-3);
  for (int k = 0; k < 120'000; ++k) {
    const double time_s = 1e-3 * k, warmer_K = 100 * (1 - std::exp(-time_s / 200));  // 0.5 K/s at first
    run.column(Channel::time).push_back(time_s);
    run.column(Channel::current).push_back(1.5 + noise(random));
    run.column(Channel::voltage).push_back(1.5 * 2.7 * (1 + 0.0039 * warmer_K) + 30 * noise(random));
  }
  EXPECT_THAT(resistance_leaps(in_blocks(run)), IsEmpty());
}

TEST(ResistanceLeap, RefusesACampaign) {
  const std::size_t half = ramp().size() / 2;
  const Recording scaled =
      with_current(ramp(), [&](double current_A, std::size_t k) { return k < half ? current_A : 1.1 * current_A; });
  const std::vector<Finding> found = channel_findings({&scaled});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].cannot_be);
  EXPECT_THAT(found[0].text, HasSubstr("ramp_60bar.h5: voltage over current leaps"));
}

TEST(CurrentsZero, IsNamedWithItsSizeWhereTheCoilHasNoVoltage) {
  for (const double zero_A : {-0.02, 0.02, 0.05}) {
    const Recording off = with_current(ramp(), [&](double current_A, std::size_t) { return current_A + zero_A; });
    EXPECT_THAT(currents_without_voltage(in_blocks(off)),
                ElementsAre(AllOf(HasSubstr(fmt::format("current stands at {:+.3f} A", zero_A)), HasSubstr("clamp"))));
  }
}

TEST(CurrentsZero, IsNoneWhereASmallVoltageDrivesTheCurrent) {
  Recording driven = with_current(ramp(), [](double current_A, std::size_t) { return current_A + 0.02; });
  for (double& voltage_V : driven.column(Channel::voltage)) voltage_V += 0.02 * 2.8;
  EXPECT_THAT(currents_without_voltage(in_blocks(driven)), IsEmpty());
}

TEST(CurrentsZero, IsNoneOfACurrentThatStillDecays) {
  Recording run;
  for (int k = 0; k < 40'000; ++k) {
    const double time_s = 1e-3 * k, cycle_s = std::fmod(time_s, 2.0);
    const double held_A = cycle_s < 1 ? 1.5 : 1.5 * std::exp(-(cycle_s - 1) / 0.03);
    run.column(Channel::time).push_back(time_s);
    run.column(Channel::current).push_back(held_A);
    run.column(Channel::voltage).push_back(cycle_s < 1 ? 1.5 * 2.7 : 0);
  }
  EXPECT_THAT(currents_without_voltage(run), IsEmpty());
}

/// Takes away what a capacitor of that time constant [s] at the input does not let through.
Recording ac_coupled(const Recording& run, double constant_s) {
  const double keep = 1 - 1e-3 / constant_s;
  double last_A = 0, out_A = 0;
  return with_current(run, [&](double current_A, std::size_t) {
    out_A = keep * (out_A + current_A - last_A);
    last_A = current_A;
    return out_A;
  });
}

TEST(CurrentWithoutMean, IsNamedAsAnInputThatIsCoupledByAC) {
  for (const double constant_s : {0.3, 3.0, 30.0}) {
    const std::string found = findings_of(ac_coupled(ramp(), constant_s));
    EXPECT_THAT(found, AllOf(HasSubstr("AC-coupled"), Not(HasSubstr("position looks")))) << constant_s;
    const Recording coupled = ac_coupled(ramp(), constant_s);
    EXPECT_THAT(all_texts(channel_findings({&coupled})), HasSubstr("AC-coupled")) << constant_s;
  }
}

TEST(CurrentWithoutMean, IsNoneOfTheNoiseOfACoilThatStaysOff) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise_A(0, 1e-3);
  const Recording off = with_current(ramp(), [&](double, std::size_t) { return noise_A(random); });
  EXPECT_THAT(signed_coil_currents(in_blocks(off)), IsEmpty());
}

TEST(SupplyVoltage, IsNamedAsSuchAndNotAsAWrongUnit) {
  for (const Recording* run : {&ramp(), &duty_cycle()}) {
    Recording supplied = *run;
    std::mt19937 random(1);
    std::normal_distribution<double> noise(24, 0.03);
    for (double& voltage_V : supplied.column(Channel::voltage)) voltage_V = noise(random);
    EXPECT_THAT(findings_of(supplied),
                AllOf(HasSubstr("voltage stays near 24.0 V"), HasSubstr("the supply's voltage, not the coil's"),
                      Not(HasSubstr("ten times")), Not(HasSubstr("leaps")), Not(HasSubstr("resistance"))));
  }
}

}  // namespace
}  // namespace spoolflow::plausibility
