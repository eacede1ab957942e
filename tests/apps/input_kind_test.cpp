#include "spoolflow/apps/terminal/input_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

class SwappedInputs : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("model.json", "{}");
    write("run.csv", "time_s,current_A\n0,1\n");
    write("campaign.toml", "[valve]\n");
  }
};

TEST_F(SwappedInputs, AreNamedWithTheLineToWriteAndNothingIsWritten) {
  for (const char* command : {"estimate", "validate", "monitor"}) {
    const std::string outputs = std::string(command) == "estimate" ? " -o out.csv" : " --json out.json";
    const Answer answer = run(std::string(command) + " run.csv model.json" + outputs);
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.message,
                ::testing::HasSubstr("write spoolflow " + std::string(command) + " model.json run.csv"));
    EXPECT_EQ(files().size(), 3U) << command;
  }
  EXPECT_THAT(run("analyse run.csv --recording model.json").message,
              ::testing::HasSubstr("analyse model.json --recording run.csv"));
}

TEST_F(SwappedInputs, OfTheWrongKindAreNamed) {
  EXPECT_THAT(run("inspect model.json").message,
              ::testing::HasSubstr("model.json: is JSON, as models are, where a recording"));
  EXPECT_THAT(run("calibrate run.csv -o m.json").message, ::testing::HasSubstr("run.csv: is a recording, where TOML"));
  EXPECT_THAT(run("calibrate model.json -o m.json").message, ::testing::HasSubstr("where TOML"));
  EXPECT_THAT(run("estimate model.json campaign.toml -o e.csv").message,
              ::testing::HasSubstr("campaign.toml: is TOML"));
}

}  // namespace
}  // namespace spoolflow::apps
