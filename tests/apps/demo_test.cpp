/// The whole way from a valve on the virtual rig to a report.
#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/apps/demo_files.hpp"
#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using Demo = CommandLine;

/// The arguments of each command that a demo has printed as one of its steps.
std::vector<std::string> steps_in(const std::string& printed) {
  constexpr std::string_view before = "  spoolflow ";
  std::vector<std::string> out;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(before)) out.push_back(line.substr(before.size()));
  }
  return out;
}

TEST_F(Demo, GoesTheWholeWayWithoutAnyFileBesideTheProgramAndShowsTheCommandsThatMakeTheSame) {
  const Answer answer = run("demo -q -o out");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, EndsWith("\nout/report.html\n"));
  EXPECT_THAT(answer.output, HasSubstr("simulated"));
  EXPECT_THAT(answer.message, IsEmpty());
  for (const char* file : {"report.html", "calibration.html"}) {
    EXPECT_THAT(content(fs::path("out") / file), StartsWith("<!doctype html>")) << file;
  }
  EXPECT_THAT(content("out/model.json"), StartsWith("{"));
  EXPECT_THAT(content("out/metrics.json"), HasSubstr("\"duty_cycle.csv"));
  EXPECT_THAT(content("out/estimate.csv"), StartsWith("time_s,flow_L_min,"));
  EXPECT_THAT(content("out/campaign/campaign.toml"), HasSubstr("direction = \"a\""));
  EXPECT_THAT(answer.output, HasSubstr("direction of the flow"));  // a whole valve, judged over signed flow

  write("printed", answer.output);
  const std::string check = "'" SPOOLFLOW_README_FIGURES "' --check '" + (folder / "printed").string() + "'";
  EXPECT_EQ(std::system(check.c_str()), 0) << "of the README's figures";

  const std::string recording = content("out/duty_cycle.csv"), estimate = content("out/estimate.csv");
  const std::vector<std::string> steps = steps_in(answer.output);
  const auto measures = [](const std::string& step) { return step.starts_with("campaign "); };
  ASSERT_EQ(steps.size(), 6U);
  for (const std::string& step : steps) {
    if (measures(step)) continue;
    const Answer again = run(step + " -q");
    EXPECT_EQ(again.status, 0) << step << again.message;
  }
  EXPECT_TRUE(content("out/duty_cycle.csv") == recording);
  EXPECT_TRUE(content("out/estimate.csv") == estimate);

  // The campaigns, which take most of the time, of one oil temperature and one pressure difference: what they have in
  // common with the demo's is the same.
  const std::string map = content("out/campaign/solenoid_map_b.csv"),
                    ramps = content("out/campaign/both_ramps_60bar.csv");
  ASSERT_FALSE(map.empty() || ramps.empty());
  fs::rename(folder / "out/campaign", folder / "demos_campaign");
  write("out/valve.toml",
        "preset = \"whole_size_6\"\n[campaign]\noil_temperatures_C = [40]\npressure_differences_bar = [70]\n"
        "ramp_rate_percent_per_s = 10\n");
  for (const std::string& step : steps) {
    if (!measures(step)) continue;
    const Answer again = run(step + " -q");
    EXPECT_EQ(again.status, 0) << step << again.message;
  }
  EXPECT_TRUE(content("out/campaign/solenoid_map_b.csv") == map);
  EXPECT_TRUE(content("out/campaign/both_ramps_60bar.csv") == ramps);
  EXPECT_THAT(content("out/flow_bench/campaign.toml"), HasSubstr("flow"));
}

TEST_F(Demo, HoldsAWholeValveAndOneOfOneDirectionAndRefusesOthers) {
  for (const std::string valve : {"whole_size_6", "size_6"}) {
    for (const char* file : {"/valve.toml", "/duty_cycle.toml"}) {
      const auto files = demo_files();
      EXPECT_EQ(std::count_if(files.begin(), files.end(), [&](const auto& each) { return each.name == valve + file; }),
                1)
          << valve << file;
    }
  }
  const Answer answer = run("demo size_7 -q -o out");
  EXPECT_EQ(answer.status, 2);
  for (const char* part : {"size_7", "whole_size_6", "size_6"}) EXPECT_THAT(answer.message, HasSubstr(part));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Demo, RefusesAFolderThatItCannotMake) {
  write("taken", "a file");
  const Answer answer = run("demo -q -o taken");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("taken"));
}

}  // namespace
}  // namespace spoolflow::apps
