/// What `inspect` says of channel maps.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Inspect : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("rig.csv", "t;cur;x;remark\n0;1;1.0;5\n0.001;1;1.1;5\n0.002;1.1;1.2;5\n");
  }
};

TEST_F(Inspect, ProposesAMapWhereNoneWasGiven) {
  EXPECT_THAT(run("inspect rig.csv").output, HasSubstr("Proposed channel map"));
}

TEST_F(Inspect, WithAMapTellsWhatItLeavesOutInsteadOfProposingOne) {
  write("map.toml",
        "[channels]\ntime = { column = \"t\", unit = \"s\" }\ncurrent = { column = \"cur\", unit = \"A\" }\n"
        "position = { column = \"x\", unit = \"mm\" }\n");
  const Answer answer = run("inspect rig.csv --channels map.toml");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, HasSubstr("Read with map.toml; columns that it does not name: remark\n"));
  EXPECT_THAT(answer.output, Not(HasSubstr("Proposed channel map")));
}

}  // namespace
}  // namespace spoolflow::apps
