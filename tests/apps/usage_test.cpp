/// What the command says before it does any work.
#include <csignal>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

/// The commands that the overview lists.
std::vector<std::string> commands() {
  std::istringstream overview(spoolflow("--help").output);
  std::vector<std::string> names;
  bool inside = false;
  for (std::string line; std::getline(overview, line);) {
    if (line == "Commands:") {
      inside = true;
    } else if (inside && line.starts_with("  ") && line.find_first_not_of(' ') == 2) {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    } else if (inside && line.empty()) {
      break;
    }
  }
  return names;
}

TEST(Usage, PrintsItsVersion) {
  const Answer answer = spoolflow("--version");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.output, MatchesRegex("spoolflow [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Usage, TeachesEveryCommandThatTheOverviewLists) {
  for (const std::string& name : commands()) {
    const Answer answer = spoolflow(name + " --help");
    EXPECT_EQ(answer.status, 0) << name;
    EXPECT_THAT(answer.message, IsEmpty()) << name;
    for (const char* part : {"Usage: spoolflow ", "\nReads:", "\nWrites:", "\nExamples:\n  spoolflow "}) {
      EXPECT_THAT(answer.output, HasSubstr(part)) << name;
    }
    EXPECT_THAT(answer.output, HasSubstr("spoolflow " + name)) << name;
  }
}

TEST(Usage, FitsATerminalOf100Columns) {
  std::vector<std::string> pages{"--help"};
  for (const std::string& name : commands()) pages.push_back(name + " --help");
  for (const std::string& page : pages) {
    std::istringstream help(spoolflow(page).output);
    for (std::string line; std::getline(help, line);)
      EXPECT_THAT(line.size(), ::testing::Le(100u)) << page << ": " << line;
  }
}

TEST(Usage, RefusesEachCommandWithoutArgumentsInOneLineThatNamesItsHelp) {
  for (const std::string& name : commands()) {
    if (name == "demo" || name == "live") continue;  // needs none
    const Answer answer = spoolflow(name);
    EXPECT_EQ(answer.status, 2) << name;
    EXPECT_THAT(answer.output, IsEmpty()) << name;
    EXPECT_THAT(answer.message,
                MatchesRegex("spoolflow " + name + ": [^\n]+ is required; see spoolflow " + name + " --help\n"));
  }
}

TEST(Usage, AsksForACommand) {
  const Answer answer = spoolflow("");
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.message, "spoolflow: no command given; see spoolflow --help\n");
}

TEST(Usage, SuggestsTheNearestWord) {
  const Answer option = spoolflow("--versoin");
  EXPECT_EQ(option.status, 2);
  EXPECT_EQ(option.message,
            "spoolflow: there is no option --versoin; did you mean '--version'?; see spoolflow --help\n");
  for (const std::string& name : commands()) {
    const Answer command = spoolflow(name.substr(0, name.size() - 1));
    EXPECT_EQ(command.status, 2);
    EXPECT_THAT(command.message, HasSubstr("did you mean '" + name + "'?")) << name;
    const Answer misspelt = spoolflow(name + " --hlep");
    EXPECT_EQ(misspelt.status, 2);
    EXPECT_THAT(misspelt.message,
                HasSubstr("spoolflow " + name + ": there is no option --hlep; did you mean '--help'?"));
  }
}

TEST(Usage, RefusesAnArgumentTooMany) {
  const Answer answer = spoolflow("--version surplus");
  EXPECT_EQ(answer.status, 0);  // what was asked for is printed all the same
  EXPECT_EQ(spoolflow("surplus").status, 2);
}

TEST(Usage, RefusesAnEmptyWordByTheNameOfItsOption) {
  for (const auto& [typed, name] :
       {std::pair{"estimate model.json '' -o -", "recording: "},
        std::pair{"estimate model.json run.csv -o out.csv --channels ''", "--channels"},
        std::pair{"validate model.json run.csv --json - --report ''", "--report"},
        std::pair{"validate model.json run.csv --json - --environment ''", "--environment"}}) {
    const Answer answer = spoolflow(typed);
    EXPECT_EQ(answer.status, 2) << typed;
    EXPECT_THAT(answer.message, HasSubstr(std::string(name))) << typed;
    EXPECT_THAT(answer.message, HasSubstr("is an empty word, as of a shell variable without a value")) << typed;
  }
}

TEST(Usage, ReportsAFullDiskEvenForHelp) {
  const Answer answer = spoolflow("--help > /dev/full");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("the disk is full"));
}

TEST(Usage, EndsLikeOtherProgramsWhenNobodyReadsOn) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::dup2(ends[1], 9), 9);
  ::close(ends[0]);
  const Answer answer = spoolflow("--help >&9");
  ::close(ends[1]);
  ::close(9);
  EXPECT_EQ(answer.status, 128 + SIGPIPE);
  EXPECT_THAT(answer.message, IsEmpty());
}

/// What bash offers for the last of `words`.
std::string completed(const std::string& words) {
  const std::string shell = "bash -c 'eval \"$(\"" SPOOLFLOW_COMMAND "\" completion bash)\"; COMP_WORDS=(spoolflow " +
                            words + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _spoolflow; echo \"${COMPREPLY[@]}\"'";
  return spoolflow("--version > /dev/null; " + shell).output;
}

TEST(Completion, OffersCommandsThenOptionsAndLeavesFilesToTheShell) {
  EXPECT_EQ(completed("esti"), "estimate\n");
  EXPECT_EQ(completed("estimate --ch"), "--channels\n");
  EXPECT_EQ(completed("validate model.json --fail"), "--fail-unmet\n");
  EXPECT_EQ(completed("help insp"), "inspect\n");
  EXPECT_EQ(completed("completion f"), "fish\n");
  EXPECT_EQ(completed("estimate model"), "\n") << "files are the shell\'s own";
}

TEST(Completion, OfEveryShellNamesEveryCommandAndOfNoOtherShellIsRefused) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Answer answer = spoolflow(std::string("completion ") + shell);
    EXPECT_EQ(answer.status, 0);
    for (const char* command : {"inspect", "calibrate", "estimate", "validate", "fleet"})
      EXPECT_NE(answer.output.find(command), std::string::npos) << shell << ' ' << command;
  }
  EXPECT_EQ(spoolflow("completion tcsh").status, 2);
}

}  // namespace
}  // namespace spoolflow::apps
