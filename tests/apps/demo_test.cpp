/// The whole way from bench recordings to a report, on the recordings inside the program.
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using Demo = CommandLine;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Demo, GoesTheWholeWayWithoutAnyFileBesideTheProgram) {
  const Answer answer = run("demo -q -o out");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, EndsWith("\nout/report.html\n"));
  EXPECT_THAT(answer.output, HasSubstr("simulated"));
  EXPECT_THAT(answer.message, IsEmpty());
  for (const char* file : {"report.html", "calibration.html"}) {
    EXPECT_THAT(content(fs::path("out") / file), StartsWith("<!doctype html>")) << file;
  }
  EXPECT_THAT(content("out/model.json"), StartsWith("{"));
  EXPECT_THAT(content("out/metrics.json"), HasSubstr("\"duty_cycle_1"));
  EXPECT_THAT(content("out/estimate.csv"), StartsWith("time_s,flow_L_min,"));
}

TEST_F(Demo, LeavesTheShippedRecordingsAsTheyStandInExamples) {
  ASSERT_EQ(run("demo -q -o out").status, 0);
  std::size_t compared = 0;
  for (const auto& entry : fs::directory_iterator(SPOOLFLOW_EXAMPLES "/valve_a")) {
    EXPECT_TRUE(bytes_of(entry.path()) == content(fs::path("out/valve_a") / entry.path().filename())) << entry.path();
    ++compared;
  }
  EXPECT_GT(compared, 5U);
}

TEST_F(Demo, RefusesAFolderThatItCannotMake) {
  write("taken", "a file");
  const Answer answer = run("demo -q -o taken");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("taken"));
}

}  // namespace
}  // namespace spoolflow::apps
