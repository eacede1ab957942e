#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;

class Monitor : public CommandLine {
 protected:
  const std::string model = SPOOLFLOW_EXAMPLE_MODEL;
  const std::string ramp = SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5";
  const std::string duty = SPOOLFLOW_EXAMPLES "/valve_a/duty_cycle_1.h5";

  void refused(const std::string& arguments, const std::string& what) const {
    const Answer answer = run("monitor " + arguments + " --json out.json -q");
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.message, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.json"));
  }
};

TEST_F(Monitor, AHealthyValveIsGoodAndItsJudgementIsABaseline) {
  const Answer first = run("monitor " + model + " " + ramp + " " + duty + " --json base.json --report page.html -q");
  ASSERT_EQ(first.status, 0) << first.message;
  const auto json = nlohmann::json::parse(content("base.json"));
  EXPECT_EQ(json["ne107"], "good");
  EXPECT_TRUE(json["causes"].empty());
  EXPECT_FALSE(json["model_doubt"]["raised"]);
  EXPECT_EQ(json["runs"].size(), 2U);
  for (const char* key : {"name", "value", "unit", "uncertainty_95", "baseline", "state"})
    EXPECT_TRUE(json["indicators"][0].contains(key)) << key;
  EXPECT_THAT(content("page.html"), HasSubstr("friction ratio"));
  double loaded_s = 0;
  for (const auto& row : json["load_histogram"]["time_s"])
    for (const double part_s : row) loaded_s += part_s;
  EXPECT_NEAR(loaded_s, 47 + 60, 1);
  const Answer later = run("monitor " + model + " " + ramp + " --baseline base.json --json - -q");
  ASSERT_EQ(later.status, 0) << later.message;
  EXPECT_EQ(nlohmann::json::parse(later.output)["ne107"], "good");
}

TEST_F(Monitor, TheSameRecordingTwiceIsNoMoreEvidenceThanOnce) {
  std::filesystem::copy_file(ramp, folder / "tuesday.h5");
  refused(model + " " + ramp + " tuesday.h5", "tuesday.h5: holds the same as " + ramp + ", and counts once");
}

TEST_F(Monitor, AValveOfWhichNothingWasJudgedIsNotCalledGoodInSilence) {
  std::string text = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";
  for (int k = 0; k < 200; ++k)
    text += fmt::format("{:.3f},{:.5f},0,{:.5f},50\n", 1e-3 * k, 1e-4 * (k % 3), 1e-4 * (k % 2));
  write("short.csv", text);
  const Answer answer = run("monitor " + model + " short.csv --json out.json -q");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("position zero were not judged: 0 s of operation hold no cycle"));
}

TEST_F(Monitor, AColumnThatMayBeMeantIsNotLeftOutInSilence) {
  std::string text = "time_s,current_A,U_coil_V,position_mm,oil_temperature_C\n";
  for (int k = 0; k < 200; ++k) text += fmt::format("{:.3f},1,{},1,50\n", 1e-3 * k, 3 + 1e-3 * (k % 3));
  write("short.csv", text);
  const Answer answer = run("monitor " + model + " short.csv --json out.json -q");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("short.csv: column 'U_coil_V' is not read: if it is voltage, name it"));
}

TEST_F(Monitor, ARecordingThatCannotBeSoundIsNamedBesideWhatItRaises) {
  std::string text = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";
  for (int k = 0; k < 30'000; ++k) {
    const double swing = std::sin(0.002 * k), noise = std::sin(1.7 * k * k);
    const double driven_A = k % 10'000 < 7000 ? 1.2 + 0.5 * swing : 0;  // then the coil rests
    text += fmt::format("{:.3f},{:.5f},{:.4f},{:.5f},50\n", 1e-3 * k, driven_A + 0.05 + 1e-3 * noise, 2.9 * driven_A,
                        (driven_A > 0 ? 1.1 + 0.9 * swing : 0) + 1e-3 * noise);
  }
  write("off.csv", text);
  const Answer answer = run("monitor " + model + " off.csv --json out.json -q");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("doubt: off.csv: current stands at +0.050 A"));
  const Answer sound = run("monitor " + model + " " + ramp + " --json out.json -q");
  EXPECT_THAT(sound.message, ::testing::Not(HasSubstr("doubt")));
}

TEST_F(Monitor, UnusableInputIsOneClearError) {
  write("no_current.csv", "time_s,position_mm\n0,0\n0.001,0\n");
  refused("nothing.json " + ramp, "nothing.json");
  refused(model + " nothing.csv", "nothing.csv");
  refused(model + " no_current.csv", "current");
  refused(model + " " + ramp + " --baseline nothing.json", "nothing.json");
  refused(model + " " + ramp + " --baseline " + model, "/baseline");
  write("other.json", R"({"baseline": {"model": "12", "b": {"windows": 3, "resistance_Ohm": 3,
         "centre": [0, 0, 0, 0, 0, 0], "spread": [0.1, 0.1, 0.1, 0.1, 0.1, 0.1]}}})");
  refused(model + " " + ramp + " --baseline other.json", "another model");
  refused(model + " " + ramp + " --adapt model2.json", "nothing to correct");
  EXPECT_FALSE(std::filesystem::exists(folder / "model2.json"));
}

}  // namespace
}  // namespace spoolflow::apps
