/// A channel that stands still, or that holds another one's signal, is named whatever the valve; sound campaigns raise
/// nothing.
#include "spoolflow/plausibility/channel_findings.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/plausibility/frozen_channel.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/units/conversion.hpp"
#include "tests/plausibility/example_campaign.hpp"
#include "tests/plausibility/finding_texts.hpp"
#include "tests/plausibility/rig_benches.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// A valve of the rig on which no limit was chosen.
const RigBenches& sound_size_10() {
  static const RigBenches valve = rig_benches("size_10", 31);
  return valve;
}

/// What is said of a copy of the campaign of which one recording is changed.
std::string said_of(const RigBenches& valve, const std::string& file, const std::function<void(Recording&)>& change) {
  RigBenches changed = valve;
  change(changed.recordings.at(file));
  return all_texts(channel_findings(changed.all()));
}

TEST(ChannelFindings, AreNoneOfSoundCampaigns) {
  EXPECT_THAT(all_texts(channel_findings(sound_size_10().all())), testing::IsEmpty());
  const RigBenches example = example_benches();
  EXPECT_THAT(all_texts(channel_findings(example.all())), testing::IsEmpty());
}

TEST(ChannelFindings, NameABenchsOilInDegFAndNoneOfABenchThatIsHot) {
  const auto said = [](double read_degC) {
    return said_of(sound_size_10(), "axial_force_map_50.csv", [&](Recording& map) {
      for (double& oil_K : map.column(Channel::oil_temperature)) oil_K += units::K_from_degC(read_degC) - 323.15;
    });
  };
  EXPECT_THAT(said(122),
              testing::HasSubstr("axial_force_map_50.csv: oil_temperature looks in degF, not degC: so read it "
                                 "is 50 degC and not 122; benches keep their oil at 0 to 80 degC"));
  EXPECT_THAT(said(95), testing::IsEmpty());
}

TEST(ChannelFindings, NameAChannelOfABenchTestThatIsFrozenForHalfOfIt) {
  const std::vector<std::pair<std::string, Channel>> channels{{"spring.csv", Channel::axial_force},
                                                              {"solenoid_map.csv", Channel::force},
                                                              {"solenoid_map.csv", Channel::current},
                                                              {"solenoid_map.csv", Channel::position},
                                                              {"axial_force_map_50.csv", Channel::position},
                                                              {"axial_force_map_50.csv", Channel::axial_force},
                                                              {"axial_force_map_50.csv", Channel::pressure_upstream},
                                                              {"axial_force_map_50.csv", Channel::flow},
                                                              {"ramp_25bar.csv", Channel::current},
                                                              {"ramp_25bar.csv", Channel::flow_reference}};
  for (const auto& each : channels) {
    const auto& file = each.first;
    const Channel channel = each.second;
    EXPECT_THAT(said_of(sound_size_10(), file, [&](Recording& run) { freeze_half(run.column(channel), 0.3); }),
                testing::StartsWith(fmt::format("{}: {} is frozen at", file, recording::name(channel))));
  }
}

/// All samples of the oil's temperature become this one [degC].
std::function<void(Recording&)> oil_at(double temperature_C) {
  return [=](Recording& run) {
    run.column(Channel::oil_temperature).assign(run.size(), units::K_from_degC(temperature_C));
  };
}

TEST(ChannelFindings, NameAnOilTemperatureThatStandsStillWhileOthersOfTheCampaignVary) {
  for (const double temperature_C : {50.0, 49.873}) {
    for (const std::string file : {"ramp_25bar.csv", "axial_force_map_50.csv"}) {
      EXPECT_THAT(said_of(sound_size_10(), file, oil_at(temperature_C)),
                  testing::StartsWith(
                      fmt::format("{}: oil_temperature is {:.4g} degC to the last digit", file, temperature_C)));
    }
  }
}

TEST(ChannelFindings, AreNoneOfOilTemperaturesThatAreTypedInOrTooCoarseToShowAChange) {
  RigBenches typed = sound_size_10();
  for (auto& [file, recording] : typed.recordings) oil_at(50)(recording);
  EXPECT_THAT(all_texts(channel_findings(typed.all())), testing::IsEmpty());
  RigBenches coarse = sound_size_10();
  for (auto& [file, recording] : coarse.recordings) {
    if (!recording.has(Channel::oil_temperature)) continue;
    oil_at(50)(recording);
    if (!file.starts_with("axial_force_map")) continue;
    std::vector<double>& oil_K = recording.column(Channel::oil_temperature);
    std::fill(oil_K.begin() + static_cast<std::ptrdiff_t>(oil_K.size() / 2), oil_K.end(), units::K_from_degC(51));
  }
  EXPECT_THAT(all_texts(channel_findings(coarse.all())), testing::IsEmpty());
}

/// A run through the centre of a whole valve of the rig, and its signed current: that of coil b less that of a.
Recording whole_valve_run() {
  const rig::ValveAndCampaign asked = rig::read_valve_and_campaign(SPOOLFLOW_EXAMPLES "/valves/whole_size_6.toml");
  const std::vector<rig::CampaignItem> items = rig::calibration_items(asked.valve, asked.campaign);
  std::vector<rig::CampaignItem> runs;
  std::ranges::copy_if(items, std::back_inserter(runs), [](const auto& item) { return item.protocol == "operation"; });
  Recording out;
  rig::run_campaign({runs.front()}, {.store = [&](const rig::CampaignItem& item, const rig::BenchRun&,
                                                  const rig::Simulation& simulation) {
                      out = simulation.recording;
                      out.file = item.file;
                    }});
  return out;
}
std::vector<double> signed_current(const Recording& run) {
  std::vector<double> out = run.column(Channel::current_b);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] -= run.column(Channel::current_a)[k];
  return out;
}

TEST(StandingChannel, IsTheDeadVoltageOrCurrentOfOneOfTwoCoils) {
  const Recording run = whole_valve_run();
  constexpr double stroke_m = 2.4e-3;
  EXPECT_THAT(standing_channel(run, stroke_m), testing::IsEmpty());
  for (const Channel dead : {Channel::voltage_a, Channel::voltage_b, Channel::current_a, Channel::current_b}) {
    Recording spoilt = run;
    std::ranges::fill(spoilt.column(dead), 0.0);
    EXPECT_THAT(standing_channel(spoilt, stroke_m),
                testing::StartsWith(fmt::format("{} stands still at 0 all along", recording::name(dead))));
  }
}

TEST(ChannelFindings, NameOneSignedCurrentInTheColumnsOfBothCoilsOrOfOne) {
  const Recording run = whole_valve_run();
  ASSERT_TRUE(run.has(Channel::current_a) && run.has(Channel::current_b));
  EXPECT_THAT(all_texts(channel_findings({&run})), testing::IsEmpty());
  const std::vector<double> current_A = signed_current(run);
  Recording one_way = run;
  std::mt19937 random(3);
  std::normal_distribution<double> noise_A(0, 1e-3);
  for (double& value_A : one_way.column(Channel::current_a)) value_A = noise_A(random);
  EXPECT_THAT(all_texts(channel_findings({&one_way})), testing::IsEmpty());
  Recording both = run;
  both.column(Channel::current_a) = both.column(Channel::current_b) = current_A;
  EXPECT_THAT(all_texts(channel_findings({&both})),
              testing::HasSubstr("current_a and current_b go together all along"));
  for (double& value : both.column(Channel::current_a)) value *= -1;
  EXPECT_THAT(all_texts(channel_findings({&both})),
              testing::HasSubstr("current_a and current_b are each other's negative all along"));
  Recording one = run;
  one.column(Channel::current_b) = current_A;
  EXPECT_THAT(all_texts(channel_findings({&one})), testing::HasSubstr("current_b goes from -"));
}

TEST(ChannelFindings, NameASignedCurrentOfBothCoilsInTheColumnOfOne) {
  EXPECT_THAT(said_of(sound_size_10(), "ramp_25bar.csv",
                      [](Recording& run) {
                        for (const Channel channel : {Channel::current, Channel::position}) {
                          std::vector<double>& values = run.column(channel);
                          for (std::size_t k = 0; k < values.size() / 2; ++k) values[k] *= -1;
                        }
                      }),
              testing::HasSubstr("record each coil's own as current_a and current_b"));
}

TEST(ChannelFindings, NameOneRecordingUnderTwoNamesAndOneNamedTwice) {
  RigBenches valve = sound_size_10();
  Recording& copy = valve.recordings["axial_force_map_70.csv"] = valve.recordings.at("axial_force_map_50.csv");
  copy.file = "axial_force_map_70.csv";
  EXPECT_THAT(all_texts(channel_findings(valve.all())),
              testing::HasSubstr("axial_force_map_50.csv and axial_force_map_70.csv hold the same samples"));
  copy.file = "axial_force_map_50.csv";
  EXPECT_THAT(all_texts(channel_findings(valve.all())), testing::HasSubstr("axial_force_map_50.csv is named twice"));
}

TEST(ChannelFindings, NameAStrokeAtWhichNoBenchRecordingEnds) {
  const RigBenches& valve = sound_size_10();
  const std::vector<const Recording*> strokes{&valve.recordings.at("spring.csv"),
                                              &valve.recordings.at("axial_force_map_50.csv")};
  EXPECT_FALSE(stroke_finding(strokes, valve.stroke_m).has_value());
  for (const double factor : {10.0, 1.25, 0.8}) {
    const auto found = stroke_finding(strokes, factor * valve.stroke_m);
    ASSERT_TRUE(found.has_value()) << factor;
    EXPECT_THAT(found->text, testing::HasSubstr(fmt::format("stroke_mm under [valve] is {:.4g}, and spring.csv",
                                                            units::mm_from_m(factor * valve.stroke_m))));
  }
}

}  // namespace
}  // namespace spoolflow::plausibility
