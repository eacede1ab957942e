/// What a user declares about the machine around the valve.
#include "spoolflow/recording/environment.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/campaign.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::HasSubstr;

Environment environment_from(const std::string& text) {
  const TemporaryFile file("press.toml", text);
  return read_environment(file.path().string());
}

std::string refused_environment(const std::string& text) {
  const TemporaryFile file("press.toml", text);
  return refusal([&] { (void)read_environment(file.path().string()); });
}

TEST(Environment, OfTheBenchLeavesNothingOpenAndThatOfAMachineDoes) {
  const Environment bench = read_environment("bench");
  EXPECT_EQ(bench.kind, "bench");
  EXPECT_EQ(bench.position_zero_m + bench.viscosity + bench.temperature_K + bench.friction + bench.ripple_Pa, 0);
  const Environment machine = read_environment("machine");
  EXPECT_GT(machine.position_zero_m, 0);
  EXPECT_GT(machine.viscosity, 0);
  EXPECT_EQ(machine.pwm_ripple, 0);  // electronics that average are the rule
}

TEST(Environment, OfAFileReplacesTheDefaultsOfItsKindAndIsInSi) {
  const Environment known =
      environment_from("[environment]\nvibration_g = 3\nhighest_pressure_bar = 100\nfriction_percent = 0\n");
  EXPECT_EQ(known.kind, "machine");
  EXPECT_NEAR(known.vibration_m_per_s2, 29.42, 0.01);
  EXPECT_DOUBLE_EQ(known.highest_Pa.value(), 100e5);
  EXPECT_EQ(known.friction, 0);
  EXPECT_EQ(known.position_zero_m, machine_environment().position_zero_m);
  const Environment bench =
      environment_from("[environment]\nkind = \"bench\"\nposition_zero_um = 20\nleakage_L_min = 0.6\n");
  EXPECT_DOUBLE_EQ(bench.position_zero_m, 20e-6);
  EXPECT_DOUBLE_EQ(bench.leakage_m3_per_s, 1e-5);
  EXPECT_EQ(bench.viscosity, 0);
}

TEST(Environment, NamesFileAndLineOfWhatItRefuses) {
  EXPECT_THAT(
      refused_environment("[environment]\n\nvibrations_g = 3\n"),
      HasSubstr("press.toml, line 3: unknown key 'vibrations_g' in [environment]; did you mean 'vibration_g'?"));
  EXPECT_THAT(refused_environment("[environment]\nvibration_g = -1\n"),
              HasSubstr("line 2: vibration_g = -1 is out of range"));
  EXPECT_THAT(refused_environment("[environment]\nposition_gain_percent = 200\n"), HasSubstr("0 to 20"));
  EXPECT_THAT(refused_environment("[environment]\nposition_zero_um = 0.008\n"),
              HasSubstr("line 2: position_zero_um = 0.008 is nearer than anybody knows it; give the half width at 95 % "
                        "in um, 0.5 to 1000, or 0 where nothing is left open"));
  EXPECT_THAT(refused_environment("[environment]\nviscosity_percent = 0.2\n"), HasSubstr("in percent, 1 to 200"));
  for (const char* pressure : {"7e6", "0.07"})
    EXPECT_THAT(refused_environment("[environment]\nhighest_pressure_bar = " + std::string(pressure)),
                HasSubstr("is not between 1 and 1000; give the highest pressure difference in bar"));
  EXPECT_THAT(refused_environment("[environment]\nkind = \"field\"\n"), HasSubstr("allowed: \"bench\""));
  EXPECT_THAT(refused_environment("environment = 3\n"), HasSubstr("environment is a table"));
  EXPECT_THAT(refused_environment("[valve]\n"), HasSubstr("has no table [environment]"));
  EXPECT_THAT(refusal([] { (void)read_environment("machin"); }),
              HasSubstr("machin: there is no such file; did you mean 'machine'?; an environment is \"bench\", "));
}

TEST(Environment, OfACampaignIsTheBenchWhereItSaysNothing) {
  const std::string rest =
      "[valve]\nname = \"A\"\nrated_flow_L_min = 80\nstroke_mm = 2.4\n[[recording]]\nprotocol = \"spring\"\n"
      "file = \"spring.csv\"\n";
  for (const auto& [text, kind] :
       {std::pair{std::string(), "bench"}, std::pair{std::string("environment = \"machine\"\n"), "machine"},
        std::pair{std::string("[environment]\nripple_bar = 2\n"), "bench"}}) {
    const TemporaryFile file("campaign.toml", text + rest);
    std::ofstream(file.folder() / "spring.csv") << "time_s\n";
    EXPECT_EQ(read_campaign(file.path()).environment->kind, kind);
  }
}

}  // namespace
}  // namespace spoolflow::recording
