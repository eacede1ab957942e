/// What reaches the command from outside its inputs' meaning: closed streams, names that steer a terminal, loops of
/// links, runs that were killed.
#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Hostile : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "model.json");
    fs::copy_file(SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5", folder / "run.h5");
  }
};

TEST_F(Hostile, AClosedStandardOutputIsNoOtherFile) {
  const Answer validated = run("validate model.json run.h5 --json metrics.json --report page.html >&-");
  EXPECT_EQ(validated.status, 2);
  EXPECT_THAT(validated.message, HasSubstr("cannot write standard output: it is closed"));
  EXPECT_FALSE(nlohmann::json::parse(content("metrics.json"), nullptr, false).is_discarded());
  EXPECT_TRUE(content("page.html").ends_with("</html>\n"));
  EXPECT_EQ(run("estimate model.json run.h5 -o whole.csv").status, 0);
  for (const char* closed : {">&-", "<&-", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(run(fmt::format("estimate model.json run.h5 -o other.csv {}", closed)).status, 0) << closed;
    EXPECT_EQ(content("other.csv"), content("whole.csv")) << closed;
  }
}

TEST_F(Hostile, AStandardOutputThatTakesNothingIsAnErrorWhereTheResultGoesThere) {
  for (const char* asked : {"inspect run.h5", "inspect run.h5 --json", "estimate model.json run.h5 -o -", "--help",
                            "--version", "analyse --print-scenario"}) {
    for (const char* closed : {">&-", "> /dev/full"}) {
      const Answer answer = run(fmt::format("{} {}", asked, closed));
      EXPECT_EQ(answer.status, 2) << asked << closed;
      EXPECT_THAT(answer.message, HasSubstr("cannot write standard output")) << asked << closed;
    }
  }
  EXPECT_EQ(run("inspect run.h5 2> /dev/full").status, 0);
  EXPECT_EQ(run("inspect missing.csv 2> /dev/full").status, 2);
}

TEST_F(Hostile, AClosedStandardInputIsARecordingThatCannotBeRead) {
  const Answer answer = run("inspect - <&-");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("standard input: cannot be read: it is closed"));
}

TEST_F(Hostile, NamesNeitherSteerTheTerminalNorForgeALine) {
  const std::string evil = "a\x1b[2J\x1b]0;b\a\nspoolflow estimate: all is well";
  const std::string harmless = "a\\u001b[2J\\u001b]0;b\\u0007\\nspoolflow estimate: all is well";
  write(evil + ".csv", "time_s,current_A,x\x1b[31m,y\xc2\x9bz\n0,1,2,3\n1,1,2,3\n");
  const std::string quoted = "'" + evil + ".csv'";
  const std::vector<std::string> commands{"estimate model.json " + quoted + " -o out.csv",
                                          "validate model.json " + quoted + " --json out.json",
                                          "inspect " + quoted,
                                          "inspect " + quoted + " --json",
                                          "calibrate " + quoted + " -o out.json",
                                          "estimate " + quoted + " run.h5 -o out.csv",
                                          "simulate " + quoted + " -o out.csv",
                                          "campaign " + quoted + " -o out",
                                          "estimate model.json run.h5 " + quoted + " -o several",
                                          "export fmu " + quoted + " -o out.fmu",
                                          "inspect run.h5 " + quoted,
                                          "'" + evil + "'"};
  for (const std::string& command : commands) {
    const Answer answer = run(command);
    EXPECT_THAT(answer.message + answer.output, Not(HasSubstr("\x1b"))) << command;
    EXPECT_THAT(answer.message + answer.output, Not(HasSubstr("\xc2\x9b"))) << command;
    EXPECT_LE(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << command;
  }
  EXPECT_THAT(run(commands[0]).message, HasSubstr(harmless));
  EXPECT_THAT(run("inspect " + quoted).output, AllOf(HasSubstr("x\\u001b[31m, y\\u009bz"), HasSubstr(harmless)));
  const auto json = nlohmann::json::parse(run("inspect " + quoted + " --json").output, nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["columns"][2], "x\x1b[31m");
}

TEST(TerminalText, LeavesWhatPeopleWriteAsItIs) {
  EXPECT_EQ(terminal_text("Ventil \u00c4, 60 \u00b0C, \u6cb9"), "Ventil \u00c4, 60 \u00b0C, \u6cb9");
  EXPECT_EQ(terminal_text("60 \xb0\x43 \xc3"), "60 \\xb0C \\xc3");                  // Latin-1, cut short
  EXPECT_EQ(terminal_text("\xed\xa0\x80 \xc0\x8a"), "\\xed\\xa0\\x80 \\xc0\\x8a");  // no characters of UTF-8
  EXPECT_EQ(terminal_text("a\u202eb\u2066c\u009bd\x7f"), "a\\u202eb\\u2066c\\u009bd\\u007f");
  EXPECT_EQ(terminal_lines("a\tb\nc\rd\n"), "a\\tb\nc\\rd\n");
  EXPECT_EQ(json_text("\"\xff\\\n\u202e"), R"("\"\ufffd\\\n\u202e")"
                                           "\n");
}

TEST_F(Hostile, LoopsOfLinksAreInputsThatCannotBeUsed) {
  fs::create_symlink("loop", folder / "loop");
  for (const char* asked :
       {"inspect loop", "estimate loop run.h5 -o out", "estimate model.json loop -o out", "calibrate loop -o out",
        "calibrate loop/campaign.toml -o out", "simulate loop -o out", "campaign loop -o out", "export fmu loop -o out",
        "inspect run.h5 --channels loop", "validate model.json run.h5 --json out --requirements loop",
        "estimate model.json run.h5 -o loop", "estimate model.json run.h5 -o loop/out", "campaign size_6 -o loop",
        "validate model.json run.h5 --report out --compare loop", "analyse model.json --json out --scenario loop"}) {
    const Answer answer = run(asked);
    EXPECT_EQ(answer.status, 2) << asked << ": " << answer.message;
    EXPECT_EQ(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << answer.message;
  }
}

TEST_F(Hostile, WhatAKilledRunLeftIsRemovedByTheNext) {
  write(".out.csv.spoolflow-0.part", "half an estimate");
  write(".out.csv.spoolflow-0.part.txt", "somebody's");
  write(".other.csv.spoolflow-0.part", "of another output");
  EXPECT_EQ(run("estimate model.json run.h5 -o out.csv").status, 0);
  EXPECT_THAT(files(), testing::ElementsAre(".other.csv.spoolflow-0.part", ".out.csv.spoolflow-0.part.txt",
                                            "model.json", "out.csv", "run.h5"));
}

TEST_F(Hostile, WhatARunThatLivesIsWritingStays) {
  OutputFile mine(folder / "out.csv");
  mine.stream() << "mine" << std::flush;
  EXPECT_EQ(run("estimate model.json run.h5 -o out.csv").status, 0);
  EXPECT_THAT(content("out.csv"), testing::StartsWith("time_s"));
  mine.commit();
  EXPECT_EQ(content("out.csv"), "mine");
  EXPECT_THAT(files(), testing::ElementsAre("model.json", "out.csv", "run.h5"));
}

}  // namespace
}  // namespace spoolflow::apps
