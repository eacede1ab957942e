#include "spoolflow/calibration/campaign_recordings.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

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

}  // namespace
}  // namespace spoolflow::calibration
