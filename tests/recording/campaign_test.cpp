#include "spoolflow/recording/campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/toml_input.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::HasSubstr;

constexpr std::string_view valve = "[valve]\nname = \"A\"\nrated_flow_L_min = 80\nstroke_mm = 2.4\n";

std::string refused_campaign(const std::string& campaign) {
  const TemporaryFile file("campaign.toml", campaign);
  std::ofstream(file.folder() / "spring.csv") << "time_s\n";
  return refusal([&] { (void)read_campaign(file.path()); });
}

std::string with_recording(std::string_view text) {
  return std::string(valve) + "[[recording]]\n" + std::string(text);
}

TEST(Campaign, IsReadInSiWithItsChannelMaps) {
  const TemporaryFile file("campaign.toml",
                           with_recording("protocol = \"spring\"\nfile = \"spring.csv\"\n"
                                          "[recording.channels]\n"
                                          "position = { column = \"LVDT\", unit = \"V\", scale = 0.24, "
                                          "offset = -0.6, to = \"mm\" }\n"
                                          "[fluid]\nviscosity_40C_mm2_per_s = 46.0\n"
                                          "[instruments]\nposition_uncertainty_mm = 0.005\n"));
  std::ofstream(file.folder() / "spring.csv") << "time_s\n";
  const Campaign campaign = read_campaign(file.path());
  EXPECT_DOUBLE_EQ(campaign.valve.rated_flow_m3_per_s, 80.0 / 60000.0);
  EXPECT_DOUBLE_EQ(campaign.valve.stroke_m, 0.0024);
  EXPECT_EQ(campaign.valve.direction, "b");
  EXPECT_DOUBLE_EQ(campaign.fluid.viscosity_40C_m2_per_s.value(), 46e-6);
  EXPECT_FALSE(campaign.fluid.density_15C_kg_per_m3.has_value());
  EXPECT_DOUBLE_EQ(campaign.instruments.position_uncertainty_m.value(), 5e-6);
  ASSERT_EQ(campaign.of(Protocol::spring).size(), 1u);
  const CampaignRecording& spring = *campaign.of(Protocol::spring).front();
  EXPECT_EQ(spring.file, file.folder() / "spring.csv");
  EXPECT_THAT(spring.place, HasSubstr("campaign.toml, line 5"));
  EXPECT_EQ(spring.channels.sources.at(Channel::position).to, "mm");
}

TEST(Campaign, IsMeasuredUnlessItSaysThatItIsSimulated) {
  const auto simulated = [](const std::string& origin) {
    const TemporaryFile file(
        "campaign.toml", std::string(valve) + origin + "[[recording]]\nprotocol = \"spring\"\nfile = \"spring.csv\"\n");
    std::ofstream(file.folder() / "spring.csv") << "time_s\n";
    return read_campaign(file.path()).valve.simulated;
  };
  EXPECT_FALSE(simulated(""));
  EXPECT_FALSE(simulated("origin = \"measured\"\n"));
  EXPECT_TRUE(simulated("origin = \"simulated\"\n"));
  EXPECT_THAT(refused_campaign(std::string(valve) + "origin = \"virtual\"\n"),
              HasSubstr("line 5: origin \"virtual\" is not known; allowed: \"measured\" (the default), \"simulated\""));
}

TEST(Campaign, NamesFileAndLineOfWhatItRefuses) {
  EXPECT_THAT(refused_campaign(std::string(valve)), HasSubstr("names no recordings"));
  EXPECT_THAT(
      refused_campaign("[valve]\nname = \"A\"\nrated_flow = 80\nstroke_mm = 2.4\n"),
      HasSubstr("campaign.toml, line 3: unknown key 'rated_flow' in [valve]; did you mean 'rated_flow_L_min'?"));
  EXPECT_THAT(refused_campaign("[valve]\nname = \"A\"\nrated_flow_L_min = -80\nstroke_mm = 2.4\n"),
              HasSubstr("line 3: 'rated_flow_L_min' in [valve] is -80; it must be above zero"));
  EXPECT_THAT(refused_campaign("[valve]\nname = \"A\"\nrated_flow_L_min = 80\n"),
              HasSubstr("[valve] needs a key 'stroke_mm'"));
  EXPECT_THAT(refused_campaign("[valve]\nname = A\n"), HasSubstr("campaign.toml, line 2: "));
  EXPECT_THAT(refused_campaign(with_recording("protocol = \"sprung\"\nfile = \"spring.csv\"\n")),
              HasSubstr("line 6: protocol = \"sprung\" is not known; did you mean 'spring'?"));
  EXPECT_THAT(refused_campaign(with_recording("protocol = \"spring\"\nfile = \"lost.csv\"\n")),
              HasSubstr("campaign.toml, line 7: the recording"));
}

/// Axial-force maps, each of what its keys say.
std::string maps_with(std::initializer_list<std::string_view> keys, std::string_view before = {}) {
  std::string out = std::string(valve) + std::string(before);
  for (const std::string_view each : keys)
    out += "[[recording]]\nprotocol = \"axial_force_map\"\nfile = \"spring.csv\"\n" + std::string(each);
  return out;
}

TEST(Campaign, RefusesNumbersThatNoValveAndNoOilHas) {
  const auto with_fluid = [](const std::string& fluid) {
    return refused_campaign(with_recording("protocol = \"spring\"\nfile = \"spring.csv\"\n[fluid]\n" + fluid));
  };
  EXPECT_THAT(with_fluid("density_15C_kg_per_m3 = 0.874\n"),
              HasSubstr("density_15C_kg_per_m3 = 0.874 is not between 500 and 2000; give it in kg/m3"));
  EXPECT_THAT(with_fluid("viscosity_40C_mm2_per_s = 46e-6\n"), HasSubstr("where it stands in m2/s times 1e6"));
  EXPECT_THAT(with_fluid("viscosity_40C_mm2_per_s = 6.8\nviscosity_100C_mm2_per_s = 46\n"),
              HasSubstr("viscosity_40C_mm2_per_s = 6.8 is not above viscosity_100C_mm2_per_s = 46"));
  EXPECT_THAT(refused_campaign("[valve]\nname = \"A\"\nrated_flow_L_min = 0.0013\nstroke_mm = 2.4\n"),
              HasSubstr("where it stands in m3/s times 60000"));
  for (const char* stroke : {"0.0024", "2400"})
    EXPECT_THAT(refused_campaign("[valve]\nname = \"A\"\nrated_flow_L_min = 80\nstroke_mm = " + std::string(stroke)),
                HasSubstr("is not between 0.1 and 100; give it in mm"));
}

TEST(Campaign, OfAUnitStatesItsFlowMeterAlone) {
  const auto unit = [](std::string_view line) {
    const TemporaryFile file("unit.toml", "[instruments]\n" + std::string(line) +
                                              "\n[[recording]]\nprotocol = \"operation\"\nfile = \"run.csv\"\n");
    std::ofstream(file.folder() / "run.csv") << "time_s\n";
    return read_unit_campaign(file.path(), {"A", 80.0 / 60000, 0.0024}).instruments.flow_uncertainty_share.value();
  };
  EXPECT_DOUBLE_EQ(unit("flow_uncertainty_percent = 3"), 0.03);
  EXPECT_THAT(refusal([&] { (void)unit("flow_uncertainty_percent = 0.03"); }), HasSubstr("is a share times 100"));
  EXPECT_THAT(refusal([&] { (void)unit("position_uncertainty_mm = 0.01"); }),
              HasSubstr("unit.toml, line 2: unknown key 'position_uncertainty_mm' in [instruments] of a unit"));
}

TEST(Campaign, OfAUnitWithoutItsTypeSaysWhereItBelongsAndHasAName) {
  const std::string run = "[[recording]]\nprotocol = \"operation\"\nfile = \"run.csv\"\n";
  EXPECT_THAT(
      refused_campaign("name = \"17\"\n" + run),
      HasSubstr("campaign.toml, line 1: a campaign needs a table [valve]; the file of a unit goes with the model of "
                "its type: `spoolflow calibrate UNIT.toml --type TYPE.json"));
  EXPECT_THAT(refused_campaign("[vale]\nname = \"A\"\n" + run), HasSubstr("did you mean 'valve'?"));
  EXPECT_THAT(refusal([&] {
                const TemporaryFile file("unit.toml", "name = \"\"\n" + run);
                (void)read_unit_campaign(file.path(), {"A", 80.0 / 60000, 0.0024});
              }),
              HasSubstr("unit.toml, line 1: the unit needs a key 'name' with a text in quotes"));
}

TEST(Campaign, RefusesUncertaintiesThatNoInstrumentHas) {
  for (const char* line : {"position_uncertainty_mm = 5e-6", "position_uncertainty_mm = 5", "current_uncertainty_A = 2",
                           "force_uncertainty_N = 1e-4", "pressure_uncertainty_bar = 1e4",
                           "temperature_uncertainty_K = 300", "temperature_uncertainty_K = 0.001"})
    EXPECT_THAT(refused_campaign(with_recording("protocol = \"spring\"\nfile = \"spring.csv\"\n[instruments]\n" +
                                                std::string(line))),
                testing::AllOf(HasSubstr("campaign.toml, line 9: "), HasSubstr("is not between"),
                               HasSubstr("give the half width at 95 %")))
        << line;
}

TEST(Campaign, MayDeclareTheOpenStopAndTheMovingMass) {
  const auto of_valve = [](const std::string& lines) {
    return std::string(valve) + lines + "[[recording]]\nprotocol = \"spring\"\nfile = \"spring.csv\"\n";
  };
  const TemporaryFile file("campaign.toml", of_valve("open_stop_mm = 2.7\nmoving_mass_g = 310\n"));
  std::ofstream(file.folder() / "spring.csv") << "time_s\n";
  const Campaign campaign = read_campaign(file.path());
  EXPECT_DOUBLE_EQ(campaign.valve.open_stop_m.value(), 2.7e-3);
  EXPECT_DOUBLE_EQ(campaign.valve.moving_mass_kg.value(), 0.31);
  EXPECT_THAT(
      refused_campaign(of_valve("open_stop_mm = 0.0027\n")),
      HasSubstr("open_stop_mm = 0.0027 is not between 1.2 and 7.2; give what the position channel shows in mm"));
  EXPECT_THAT(refused_campaign(of_valve("moving_mass_g = 0.31\n")), HasSubstr("where it stands in kg times 1000"));
}

TEST(Campaign, KnowsTheEdgeThatAnAxialForceMapIsOfAndItsDirection) {
  const TemporaryFile file("campaign.toml", maps_with({"edge = \"PB\"\n", "edge = \"AT\"\ndirection = \"b\"\n",
                                                       "edge = \"PA\"\n", "edge = \"BT\"\n"},
                                                      "[load]\narea_ratio = 0.6\n"));
  std::ofstream(file.folder() / "spring.csv") << "time_s\n";
  const Campaign campaign = read_campaign(file.path());
  EXPECT_EQ(campaign.load.area_ratio, 0.6);
  std::string edges;
  for (const CampaignRecording& each : campaign.recordings) edges += each.edge + each.direction + " ";
  EXPECT_EQ(edges, "PBb ATb PAa BTa ");
}

std::string metered(std::string campaign) {
  const std::string_view map = "axial_force_map";
  for (std::size_t at = campaign.find(map); at != std::string::npos; at = campaign.find(map))
    campaign.replace(at, map.size(), "metering");
  return campaign;
}

TEST(Campaign, TakesStrokesOnAFlowBenchOneEdgeAtATime) {
  const TemporaryFile file("campaign.toml", metered(maps_with({"edge = \"PB\"\n", "edge = \"AT\"\n"})));
  std::ofstream(file.folder() / "spring.csv") << "time_s\n";
  const Campaign campaign = read_campaign(file.path());
  EXPECT_EQ(campaign.recordings.front().edge, "PB");
  EXPECT_EQ(campaign.recordings.back().edge, "AT");
  EXPECT_THAT(refused_campaign(metered(maps_with({"edge = \"PB\"\n"}))), HasSubstr("add metering recordings with"));
  EXPECT_THAT(refused_campaign(metered(maps_with({"edge = \"PB\"\n", "edge = \"AT\"\n"})) +
                               "[[recording]]\nprotocol = \"axial_force_map\"\nfile = \"spring.csv\"\nedge = \"PB\"\n"),
              HasSubstr("edges are measured one at a time by one of the two"));
}

TEST(Campaign, TakesBothEdgesAsMeasuredTogetherAndEqualFlowsWhereNothingIsSaid) {
  const TemporaryFile file("campaign.toml", maps_with({"", "direction = \"a\"\n"}));
  std::ofstream(file.folder() / "spring.csv") << "time_s\n";
  const Campaign campaign = read_campaign(file.path());
  EXPECT_EQ(campaign.load.area_ratio, 1);
  EXPECT_EQ(campaign.recordings.front().edge, "");
  EXPECT_EQ(campaign.recordings.back().direction, "a");
}

TEST(Campaign, RefusesEdgesThatMakeNoPath) {
  EXPECT_THAT(refused_campaign(maps_with({"edge = \"PT\"\n"})),
              HasSubstr("line 8: edge \"PT\" is not known; allowed: \"PB\" and \"AT\" (direction b)"));
  EXPECT_THAT(refused_campaign(maps_with({"edge = \"PB\"\ndirection = \"a\"\n"})),
              HasSubstr("line 8: edge \"PB\" is of direction \"b\", and direction = \"a\" is given"));
  EXPECT_THAT(refused_campaign(with_recording("protocol = \"spring\"\nfile = \"spring.csv\"\nedge = \"PB\"\n")),
              HasSubstr("line 8: edge = \"PB\" stands with protocol \"spring\""));
  EXPECT_THAT(refused_campaign(maps_with({"edge = \"PA\"\n", "edge = \"PA\"\n"})),
              HasSubstr("of direction \"a\" edge PA alone was measured, and the oil also passes BT"));
  EXPECT_THAT(refused_campaign(maps_with({"edge = \"PB\"\n", "edge = \"AT\"\n", ""})),
              HasSubstr("spring.csv names no edge, and spring.csv is of edge PB alone, both of direction \"b\""));
}

TEST(Campaign, RefusesAnAreaRatioThatIsNoCylinders) {
  EXPECT_THAT(
      refused_campaign(maps_with({""}, "[load]\narea_ratio = 60\n")),
      HasSubstr("line 6: area_ratio = 60 is not between 0.1 and 10; give the piston's area at port A over that at "
                "port B"));
  EXPECT_THAT(refused_campaign(maps_with({""}, "[load]\narea_ratio = 0\n")), HasSubstr("it must be above zero"));
  EXPECT_THAT(refused_campaign(maps_with({""}, "[load]\nratio = 0.6\n")), HasSubstr("unknown key 'ratio' in [load]"));
}

TEST(Campaign, ReadsNothingOutsideItsFolderUnlessAllowed) {
  const TemporaryFile outside("secret.csv", "time_s\n");
  const std::string climbing = "../" + outside.folder().filename().string() + "/secret.csv";
  for (const std::string& name :
       {climbing, outside.path().string(), std::string("link.csv"), std::string("sub/link")}) {
    const TemporaryFile file("campaign.toml", with_recording("protocol = \"spring\"\nfile = \"" + name + "\"\n"));
    std::filesystem::create_symlink(outside.path(), file.folder() / "link.csv");
    std::filesystem::create_directory(file.folder() / "sub");
    std::filesystem::create_symlink(outside.path(), file.folder() / "sub" / "link");
    EXPECT_THAT(refusal([&] { (void)read_campaign(file.path()); }),
                HasSubstr("campaign.toml, line 7: the recording " + (file.folder() / name).string() +
                          " stands outside the campaign's folder"));
    EXPECT_EQ(read_campaign(file.path(), OutsideFiles::allowed).recordings.size(), 1U) << name;
  }
}

TEST(Campaign, ReadsItsFolderByWhateverNameThatIsGiven) {
  const TemporaryFile file("campaign.toml", with_recording("protocol = \"spring\"\nfile = \"./sub/../..run.csv\"\n"));
  std::filesystem::create_directory(file.folder() / "sub");
  std::ofstream(file.folder() / "..run.csv") << "time_s\n";
  const std::filesystem::path link = file.folder().string() + "_link";
  std::filesystem::create_symlink(file.folder(), link);
  EXPECT_EQ(read_campaign(link / "campaign.toml").recordings.size(), 1U);
  std::filesystem::remove(link);
}

TEST(Campaign, NestsNoDeeperThanItsReaderCanFollow) {
  std::string dotted = "a";
  for (int k = 0; k < 40000; ++k) dotted += ".a";
  EXPECT_THAT(refused_campaign(dotted + " = 1\n"), HasSubstr("campaign.toml, line 1: nests deeper than 32 levels"));
  EXPECT_THAT(refused_campaign("\n[" + dotted + "]\n"), HasSubstr("line 2: nests deeper than 32 levels"));
  EXPECT_THAT(refused_campaign("a = " + std::string(100000, '[')), HasSubstr("nests deeper than 32 levels"));
  EXPECT_THAT(refused_campaign("a = " + std::string(5 << 20, ' ')), HasSubstr("is larger than 4 MiB"));
  // What stands in quotes and comments nests nothing.
  const std::string text = "name = \"" + dotted + "[[[\\\"{{{\"\n# " + dotted + "\n";
  const std::string many_lines = "more = \"\"\"\n" + dotted + "\"\"\n\"\"\"\nlast = '" + dotted + "\\'\n";
  EXPECT_EQ(too_deep_toml(text + many_lines), std::nullopt);
  EXPECT_TRUE(too_deep_toml(text + many_lines + dotted));
}

TEST(Campaign, RefusesChannelsAndUnitsThatDoNotFit) {
  const auto channels = [](std::string_view entry) {
    return with_recording("protocol = \"spring\"\nfile = \"spring.csv\"\n[recording.channels]\n") + std::string(entry);
  };
  EXPECT_THAT(refused_campaign(channels("presure_upstream = { column = \"p\" }\n")),
              HasSubstr("line 9: unknown channel 'presure_upstream'; did you mean 'pressure_upstream'?"));
  EXPECT_THAT(refused_campaign(channels("pressure_upstream = { column = \"p\", unit = \"N\" }\n")),
              HasSubstr("line 9: channel pressure_upstream cannot be in 'N', which is a unit of force; allowed: bar"));
  EXPECT_THAT(refused_campaign(channels("current = { colum = \"p\", unit = \"A\" }\n")),
              HasSubstr("did you mean 'column'?"));
  EXPECT_THAT(refused_campaign(channels("current = { column = \"p\", unit = \"A\", scale = 0 }\n")),
              HasSubstr("the scale of channel current is zero"));
}

}  // namespace
}  // namespace spoolflow::recording
