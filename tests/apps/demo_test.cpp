/// The whole way from a valve on the virtual rig to a report.
#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

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
  std::istringstream lines(answer.output);
  int steps = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find("  spoolflow ");
    if (at != 0) continue;
    const Answer step = run(line.substr(12) + " -q");
    EXPECT_EQ(step.status, 0) << line << step.message;
    ++steps;
  }
  EXPECT_EQ(steps, 6);  // the last one: the same campaign on a flow bench
  EXPECT_TRUE(content("out/duty_cycle.csv") == recording);
  EXPECT_TRUE(content("out/estimate.csv") == estimate);
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
