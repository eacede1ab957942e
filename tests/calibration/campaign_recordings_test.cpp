#include "spoolflow/calibration/campaign_recordings.hpp"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/completeness.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

using testing::HasSubstr;

std::string entry(const std::string& protocol, const std::string& keys) {
  return "[[recording]]\nprotocol = \"" + protocol + "\"\nfile = \"all.csv\"\n" + keys + "\n";
}

TEST(CampaignRecordings, GiveEachDirectionItsEdgesAndTheFlowThatTheCylinderPassesOverItsOutlet) {
  std::string text = "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n[load]\narea_ratio = 0.5\n";
  for (const char* edge : {"PB", "AT", "BT", "PA"})
    text += entry("axial_force_map", "edge = \"" + std::string(edge) + "\"");
  for (const char* direction : {"a", "b"}) {
    for (const char* protocol : {"spring", "solenoid_force_map"})
      text += entry(protocol, "direction = \"" + std::string(direction) + "\"");
  }
  const recording::TemporaryFile file("campaign.toml", text);
  std::ofstream(file.folder() / "all.csv")
      << "time_s,position_mm,axial_force_N,current_A,force_N,pressure_difference_bar,flow_L_min\n"
         "0,0,9,1,20,10,0\n0.01,0.1,9.1,1,20,10,0\n0.02,0.2,9.2,1,20,10,0\n";
  const recording::Campaign campaign = recording::read_campaign(file.path());
  ReadCampaign read(campaign);
  std::vector<const recording::Recording*> in_order;
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) in_order.push_back(&read.read_next());
  const AxialForceMaps b = read.of("b").axial_force_maps, a = read.of("a").axial_force_maps;
  EXPECT_EQ(b.inlet, Recordings{in_order[0]});
  EXPECT_EQ(b.outlet, Recordings{in_order[1]});
  EXPECT_EQ(a.outlet, Recordings{in_order[2]});
  EXPECT_EQ(a.inlet, Recordings{in_order[3]});
  EXPECT_TRUE(b.joined.empty());
  EXPECT_DOUBLE_EQ(b.outlet_flow_ratio, 0.5);  // what B takes leaves A behind half the area
  EXPECT_DOUBLE_EQ(a.outlet_flow_ratio, 2);
  EXPECT_FALSE(a.edges_are_unknown());
}

TEST(CampaignRecordings, GiveTheOilAndStrokesAtHeldPressureDifferencesAsOperationWhereNoRunIs) {
  const auto operation_of = [](const std::string& run) {
    std::string text =
        "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n[fluid]\nviscosity_40C_mm2_per_s = 32\n";
    for (const char* protocol : {"spring", "solenoid_force_map", "axial_force_map", "metering"})
      text += entry(protocol, "");
    const recording::TemporaryFile file("campaign.toml", text + run);
    std::ofstream(file.folder() / "all.csv")
        << "time_s,position_mm,axial_force_N,current_A,voltage_V,force_N,pressure_difference_bar,flow_L_min,flow_"
           "reference_L_min\n"
           "0,0,9,1,3,20,10,0,0\n0.01,0.1,9.1,1,3,20,10,0,0\n0.02,0.2,9.2,1,3,20,10,0,0\n";
    const recording::Campaign campaign = recording::read_campaign(file.path());
    ReadCampaign read(campaign);
    std::vector<const recording::Recording*> in_order;
    for (std::size_t k = 0; k < campaign.recordings.size(); ++k) in_order.push_back(&read.read_next());
    EXPECT_EQ(read.of("b").fluid.viscosity_40C_m2_per_s, 32e-6);
    const Recordings operation = read.of("b").operation;
    EXPECT_EQ(operation.size(), 1U);
    return std::find(in_order.begin(), in_order.end(), operation.front()) - in_order.begin();
  };
  EXPECT_EQ(operation_of(""), 3);
  EXPECT_EQ(operation_of(entry("operation", "")), 4);
}

/// Writes a campaign of all bench tests but those of `without`, each in a file of the given header.
std::string refused_campaign(const std::string& top, const std::string& header, const std::string& without) {
  std::string text = "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n" + top;
  for (const char* protocol : {"spring", "solenoid_force_map", "axial_force_map"}) {
    if (without.find(protocol) == std::string::npos) text += entry(protocol, "");
  }
  text += entry("operation", "");
  const recording::TemporaryFile file("campaign.toml", text);
  std::ofstream(file.folder() / "all.csv") << header << "\n0,0,9,1,20,10,0\n0.01,0.1,9.1,1,20,10,0\n";
  const recording::Campaign campaign = recording::read_campaign(file.path());
  try {
    ReadCampaign read(campaign);
    for (std::size_t k = 0; k < campaign.recordings.size(); ++k) (void)read.read_next();
  } catch (const CalibrationError& error) {
    return error.what();
  }
  return {};
}

constexpr const char* complete =
    "time_s,position_mm,axial_force_N,current_A,force_N,pressure_difference_bar,flow_reference_L_min";

TEST(CampaignRecordings, ListEveryMissingTestAndHowItIsRecordedBeforeSamplesAreRead) {
  const std::string text = refused_campaign("", complete, "spring axial_force_map");
  EXPECT_THAT(text, HasSubstr("no recording with protocol \"spring\": stroke the spool both ways"));
  EXPECT_THAT(text, HasSubstr("no recording with protocol \"axial_force_map\": sweep the position"));
}

TEST(CampaignRecordings, OnAFlowBenchAskForItsOwnTestsInsteadOfForceRigs) {
  const recording::TemporaryFile file(
      "campaign.toml", "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n" + entry("metering", ""));
  std::ofstream(file.folder() / "all.csv")
      << "time_s,position_mm,current_A,voltage_V,pressure_difference_bar,flow_reference_L_min\n0,0,0,0,10,0\n";
  const recording::Campaign campaign = recording::read_campaign(file.path());
  EXPECT_EQ(bench_directions(campaign), std::vector<std::string>{"b"});
  try {
    (void)complete_read_options(campaign);
    FAIL() << "no refusal";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("no recording with protocol \"unpressurised_strokes\": stroke the valve slowly"));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("solenoid_force_map")));
  }
}

TEST(CampaignRecordings, AForceMapTogetherWithStrokesOfAFlowBenchIsComplete) {
  std::string text = "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n";
  for (const char* protocol : {"unpressurised_strokes", "solenoid_force_map", "metering"}) text += entry(protocol, "");
  const recording::TemporaryFile file("campaign.toml", text);
  std::ofstream(file.folder() / "all.csv") << "time_s,position_mm,current_A,voltage_V,force_N,pressure_difference_bar,"
                                              "flow_reference_L_min\n0,0,0,0,0,10,0\n";
  const recording::Campaign campaign = recording::read_campaign(file.path());
  EXPECT_EQ(complete_read_options(campaign).size(), 3U);
}

TEST(CampaignRecordings, MovesOfTheSolenoidAloneServeWithItsForceMapOnly) {
  for (const bool mapped : {false, true}) {
    std::string text = "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n";
    for (const char* protocol : {"unpressurised_strokes", "metering", "solenoid_dynamic"}) text += entry(protocol, "");
    if (mapped) text += entry("solenoid_force_map", "");
    const recording::TemporaryFile file("campaign.toml", text);
    std::ofstream(file.folder() / "all.csv")
        << "time_s,position_mm,current_A,voltage_V,force_N,pressure_difference_bar,"
           "flow_reference_L_min\n0,0,0,0,0,10,0\n0.01,0.1,0,0,0,10,0\n";
    const recording::Campaign campaign = recording::read_campaign(file.path());
    ReadCampaign read(campaign);
    for (std::size_t k = 0; k < campaign.recordings.size(); ++k) (void)read.read_next();
    EXPECT_EQ(read.unused("b").size(), mapped ? 0U : 1U);
  }
}

TEST(CampaignRecordings, ListEveryMissingChannelOfEveryFileAtOnce) {
  const std::string text = refused_campaign(
      "", "time_s,position_mm,axial_force_N,else_A,else_N,pressure_upstream_bar,flow_reference_L_min", "");
  EXPECT_THAT(text, HasSubstr("channel current is missing"));
  EXPECT_THAT(text, HasSubstr("channel force is missing"));
  EXPECT_THAT(text, HasSubstr("both \"pressure_upstream\" and \"pressure_downstream\""));
  EXPECT_THAT(text, HasSubstr("has no coil current"));
}

TEST(CampaignRecordings, OneChannelMapServesAllFilesAndEntriesThatAFileLacksAreLeftOut) {
  const std::string own = "[recording.channels]\nposition = { column = \"x\", unit = \"mm\" }\n";
  const std::string text =
      "[valve]\nname = \"W\"\nrated_flow_L_min = 60\nstroke_mm = 2.4\n"
      "[channels]\nposition = { column = \"LVDT\", unit = \"mm\" }\ncurrent = { column = \"I\", unit = \"mA\" }\n"
      "[[recording]]\nprotocol = \"spring\"\nfile = \"spring.csv\"\n" +
      own + entry("solenoid_force_map", "") + entry("axial_force_map", "");
  const recording::TemporaryFile file("campaign.toml", text);
  std::ofstream(file.folder() / "spring.csv") << "time_s,x,LVDT,axial_force_N\n0,1,5,9\n0.01,2,5,9\n";
  std::ofstream(file.folder() / "all.csv") << "time_s,LVDT,axial_force_N,I,force_N,pressure_difference_bar,flow_L_min\n"
                                              "0,0.5,9,1000,20,10,0\n0.01,0.6,9.1,1000,20,10,0\n";
  const recording::Campaign campaign = recording::read_campaign(file.path());
  ReadCampaign read(campaign);
  EXPECT_DOUBLE_EQ(read.read_next()[recording::Channel::position][0], 1e-3);  // its own entry comes first
  const recording::Recording& map = read.read_next();
  EXPECT_DOUBLE_EQ(map[recording::Channel::position][0], 0.5e-3);
  EXPECT_DOUBLE_EQ(map[recording::Channel::current][0], 1);
}

TEST(CampaignRecordings, AMisspeltEntryOfTheCampaignsChannelMapIsRefused) {
  EXPECT_THAT(refused_campaign("[channels]\nvoltage = { column = \"curent_A\", unit = \"V\" }\n", complete, ""),
              HasSubstr("channel voltage is mapped to column 'curent_A', which no recording of the campaign has; did "
                        "you mean 'current_A'?"));
}

}  // namespace
}  // namespace spoolflow::calibration
