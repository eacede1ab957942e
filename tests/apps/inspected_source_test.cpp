/// What `inspect` says of a pipe, and of times that are not the samples'.
#include <filesystem>
#include <string>
#include <sys/stat.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;

using InspectedSource = CommandLine;

TEST_F(InspectedSource, APipeIsToBeGivenOnStandardInput) {
  ASSERT_EQ(::mkfifo((folder / "rig.fifo").c_str(), 0600), 0);
  const Answer answer = run("inspect rig.fifo");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message,
              HasSubstr("rig.fifo: is a pipe; give what it holds on standard input: spoolflow inspect - "
                        "< rig.fifo"));
}

TEST_F(InspectedSource, TimesOfWholeSecondsAreSaidToBeRoundedAndOfNoOtherUnit) {
  std::string text = "time_s,current_A,position_mm\n";
  for (int k = 0; k < 3000; ++k)
    text += fmt::format("{},{:.3f},{:.4f}\n", k / 1000, 0.001 * (k % 900), 0.002 * (k % 900));
  write("rounded.csv", text);
  const Answer answer = run("inspect rounded.csv");
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.message, "");
  EXPECT_THAT(answer.output, HasSubstr("(1e+03 have the same time on average: write the times with more digits)"));
}

}  // namespace
}  // namespace spoolflow::apps
