/// Files of the release that users write, and blocks that sites wrote, are read (docs/stability.md). The files name
/// every key: a key that goes is refused as unknown.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "addons/fleet/settings.hpp"
#include "addons/live/blocks/block.hpp"
#include "addons/live/site.hpp"
#include "addons/live/tests/temporary_folder.hpp"
#include "spoolflow/analysis/scenario.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/references.hpp"
#include "spoolflow/rig/bench/scenario.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/validation/requirements.hpp"

namespace spoolflow {
namespace {

namespace fs = std::filesystem;

const fs::path release = SPOOLFLOW_RELEASE;

/// A folder with the release's files and what they name.
class ReleaseFiles : public live::InFolder {
 protected:
  void SetUp() override {
    live::InFolder::SetUp();
    for (const fs::directory_entry& file : fs::directory_iterator(release / "files")) {
      fs::copy_file(file.path(), folder / file.path().filename());
    }
    fs::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "model.json");
    write("run.csv", "time_s,current_A,position_mm\n0,0,0\n1,0,0\n");
    write("marks.csv", "begin_s,end_s\n0.1,0.5\n");
    write("page.pem", "of a server\n");
    write("page.key", "a_secret_of_some_length\n");
    fs::permissions(folder / "page.key", fs::perms::owner_read);
    ASSERT_EQ(setenv("SPOOLFLOW_STABILITY_TOKEN", "token", 1), 0);
  }
};

TEST_F(ReleaseFiles, ASiteWithEveryKeyIsRead) {
  const live::SiteSettings site = live::read_site(path("site.toml"));
  ASSERT_EQ(site.valves.size(), 5U);
  EXPECT_EQ(site.stalled_after_s, 1.5);
  EXPECT_EQ(site.notify.size(), 2U);
  EXPECT_TRUE(site.can && site.modbus && site.mqtt && site.plotjuggler && site.udp);
  EXPECT_EQ(site.valves[1].channels.sources.size(), 2U);
  EXPECT_EQ(std::get<live::RigSettings>(site.valves[4].source).ageing.until.friction_factor, 2);
}

TEST_F(ReleaseFiles, AFleetWithEveryKeyIsRead) {
  const fleet::FleetSettings settings = fleet::read_fleet(path("fleet.toml"));
  EXPECT_EQ(settings.stream.replicas, 3);
  EXPECT_EQ(settings.worker.lease_s, 4);
  EXPECT_EQ(settings.sites, std::vector<std::string>{"hall_3"});
}

TEST_F(ReleaseFiles, ACampaignWithEveryKeyAndProtocolIsRead) {
  const recording::Campaign campaign = recording::read_campaign(path("campaign.toml"));
  EXPECT_EQ(campaign.recordings.size(), 8U);
  EXPECT_EQ(campaign.load.area_ratio, 0.6);
  EXPECT_EQ(campaign.tolerances.values.size(), 15U);
  EXPECT_EQ(campaign.recordings[3].edge, "PB");
  EXPECT_EQ(campaign.channels.sources.size(), 1U);
}

TEST_F(ReleaseFiles, LimitsAndReferencesOfEveryKindAreRead) {
  EXPECT_EQ(validation::read_requirements(path("limits.toml")).limits.size(), 9U);
  EXPECT_EQ(recording::read_references(path("references.toml")).size(), 4U);
}

TEST_F(ReleaseFiles, ValvesAndScenariosOfTheRigAndOfAnalyseAreRead) {
  EXPECT_NO_THROW((void)rig::read_valve_and_campaign(path("valve.toml")));
  EXPECT_NO_THROW((void)rig::read_scenario(path("scenario.toml")));
  EXPECT_EQ(analysis::read_scenario(path("analysis.toml")).points.positions_percent.size(), 4U);
}

fleet::Block block_of(const std::string& name) {
  std::ifstream in(release / name, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  const auto read = fleet::read_block(bytes);
  EXPECT_TRUE(std::holds_alternative<fleet::Block>(read)) << name;
  return std::holds_alternative<fleet::Block>(read) ? std::get<fleet::Block>(read) : fleet::Block{};
}

TEST(ReleaseBlocks, OfSamplesIsRead) {
  const fleet::Block block = block_of("block_1.bin");
  EXPECT_EQ(block.valve, "hall_3/press_1");
  EXPECT_EQ(block.number, 12U);
  EXPECT_EQ(block.first, 11U);
  EXPECT_EQ(block.wall_ms, 1'700'000'000'000);
  ASSERT_EQ(block.samples.size(), 100U);
  EXPECT_NEAR(block.samples[99].time_s, 0.099, 1e-8);
  EXPECT_NEAR(block.samples[99].current_A, 1.099, 1e-4);
  EXPECT_NEAR(block.samples[99].position_m, 1.099e-3, 1e-8);
  EXPECT_TRUE(std::isnan(block.samples[50].position_m));
  EXPECT_NEAR(block.samples[99].oil_temperature_K, 313, 1e-2);
}

TEST(ReleaseBlocks, OfAReportIsRead) {
  const fleet::Block block = block_of("block_2.bin");
  ASSERT_TRUE(block.report);
  EXPECT_EQ(block.report->samples, 7500U);
  EXPECT_EQ(block.report->energy_J, 0.25);
  EXPECT_EQ(block.report->summary.flow_mean_m3_per_s, 2e-5);
  ASSERT_EQ(block.report->indicators.size(), 1U);
  EXPECT_EQ(block.report->indicators[0].name, "friction_ratio");
  ASSERT_EQ(block.report->events.size(), 1U);
  EXPECT_EQ(block.report->alarms.at(0).cause, "friction");
}

}  // namespace
}  // namespace spoolflow
