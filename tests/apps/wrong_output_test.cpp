/// Outputs that cannot be written, and interruptions: exit status 2, a message, and no half-written file.
#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class WrongOutput : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "model.json");
    fs::copy_file(SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5", folder / "run.h5");
    write("out", "result of an earlier run");
  }
  void TearDown() override {
    EXPECT_EQ(content("out"), "result of an earlier run");
    EXPECT_THAT(files(), ElementsAre("model.json", "out", "run.h5"));
    CommandLine::TearDown();
  }

  void expect_refused(const std::string& arguments, const std::string& reason) const {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.message, HasSubstr(reason)) << arguments;
  }
};

TEST_F(WrongOutput, FolderThatIsNotThere) {
  expect_refused("estimate model.json run.h5 -o nowhere/estimate.csv", "the folder nowhere does not exist");
  expect_refused("validate model.json run.h5 --report nowhere/report.html --json out",
                 "the folder nowhere does not exist");
  expect_refused("validate model.json run.h5 --report out --json nowhere/metrics.json",
                 "the folder nowhere does not exist");
  expect_refused("calibrate '" SPOOLFLOW_EXAMPLES "/valve_a/campaign.toml' -o nowhere/model.json",
                 "the folder nowhere does not exist");
}

TEST_F(WrongOutput, FolderAsAFile) {
  expect_refused("estimate model.json run.h5 -o .", "it is a folder");
}

TEST_F(WrongOutput, NoFileIsOtherThanItsNameSays) {
  const std::string simulate = "simulate '" SPOOLFLOW_EXAMPLES "/scenarios/ramp.toml' -o ";
  expect_refused(simulate + "run.parquet", "cannot write run.parquet: this is written as CSV alone");
  expect_refused(simulate + "run.csv --truth truth.XLSX", "cannot write truth.XLSX: this is written as CSV alone");
}

TEST_F(WrongOutput, FullDisk) {
  expect_refused("estimate model.json run.h5 -o /dev/full", "the disk is full");
  expect_refused("estimate model.json run.h5 -o - > /dev/full", "the disk is full");
  expect_refused("validate model.json run.h5 --report /dev/full --json /dev/null", "the disk is full");
  expect_refused("calibrate '" SPOOLFLOW_EXAMPLES "/valve_a/campaign.toml' -o /dev/full", "the disk is full");
}

TEST_F(WrongOutput, SizeLimitInMidRun) {
  expect_refused("--version; ulimit -f 64; '" SPOOLFLOW_COMMAND "' estimate model.json run.h5 -o out",
                 "grew past the size limit");
}

TEST_F(WrongOutput, InputAsOutput) {
  const std::string before = content("run.h5");
  expect_refused("estimate model.json run.h5 -o run.h5", "the same file");
  expect_refused("estimate model.json run.h5 -o ./model.json", "the same file");
  expect_refused("validate model.json run.h5 --report run.h5 --json out", "the same file");
  expect_refused("validate model.json run.h5 --report other --json ./other", "the same file");
  expect_refused("estimate model.json run.h5 -o other.csv --json ./other.csv", "also uses other.csv");
  EXPECT_EQ(content("run.h5"), before);
}

/// A command that reads from a pipe of which this process holds the other end.
class Piped {
 public:
  Piped(const fs::path& folder, const std::vector<const char*>& arguments) {
    std::vector<char*> words;
    for (const char* word : arguments) words.push_back(const_cast<char*>(word));
    words.push_back(nullptr);
    if (::pipe(input_.data()) != 0 || ::pipe(message_.data()) != 0) throw std::runtime_error("no pipe");
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(input_[0], STDIN_FILENO);
      ::dup2(message_[1], STDERR_FILENO);
      for (const int end : {input_[0], input_[1], message_[0], message_[1]}) ::close(end);
      if (::chdir(folder.c_str()) == 0) ::execv(SPOOLFLOW_COMMAND, words.data());
      ::_exit(127);
    }
    ::close(input_[0]);
    ::close(message_[1]);
  }
  void send(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(input_[1], text.data(), text.size());
      ASSERT_GT(written, 0);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  [[nodiscard]] Answer interrupt(int signal) const {
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    Answer answer{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), {}, std::string(1000, '\0')};
    const ssize_t got = ::read(message_[0], answer.message.data(), answer.message.size());
    answer.message.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    ::close(message_[0]);
    ::close(input_[1]);
    return answer;
  }

 private:
  pid_t process_ = -1;
  std::array<int, 2> input_{}, message_{};
};

TEST_F(WrongOutput, CtrlCAndTerminationInMidRun) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Piped estimate(folder, {"spoolflow", "estimate", "model.json", "-", "-o", "out"});
    std::string text = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";
    for (int k = 0; k < 100'000; ++k) text += fmt::format("{:.3f},0.5,3,0.3,50\n", 0.001 * k);
    estimate.send(text);  // more than the command reads at once
    // Mid-run is when the unfinished file stands beside the target; ten seconds are for a very slow machine.
    for (int wait = 0; files().size() < 4 && wait < 1000; ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(files().size(), 4u) << "no unfinished file appeared";
    const Answer answer = estimate.interrupt(signal);
    EXPECT_EQ(answer.status, 128 + signal);
    EXPECT_EQ(answer.message, "spoolflow estimate: interrupted; nothing was written\n");
  }
}

/// Files that a command reads through others are inputs as well.
class ReadThroughOthers : public CommandLine {
 protected:
  void keeps(const std::string& file, const std::string& arguments) const {
    const std::string before = content(file);
    const Answer answer = run(arguments + " -q");
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.message, ::testing::HasSubstr("this command also uses")) << arguments;
    EXPECT_EQ(content(file), before) << arguments;
  }
};

TEST_F(ReadThroughOthers, AreNotOverwritten) {
  const std::string of_run = " " SPOOLFLOW_EXAMPLE_MODEL " " SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5 ";
  write("machine.toml", "[environment]\nfriction_percent = 5\n");
  keeps("machine.toml", "estimate" + of_run + "--environment machine.toml -o machine.toml");
  keeps("machine.toml", "validate" + of_run + "--environment machine.toml --json machine.toml");
  write("worn.toml", "preset = \"size_6\"\n");
  write("run.toml", "protocol = \"duty_cycle\"\nvalve = \"worn.toml\"\n[run]\nduration_s = 1\n");
  keeps("worn.toml", "simulate run.toml -o worn.toml");
  keeps("worn.toml", "simulate run.toml -o run.csv --truth worn.toml");
  write("study.toml", "[study]\nvalve = \"worn.toml\"\n");
  keeps("worn.toml", "analyse " SPOOLFLOW_EXAMPLE_MODEL " --scenario study.toml --json worn.toml");
}

TEST_F(ReadThroughOthers, ACampaignOfTheRigReplacesNoOther) {
  std::filesystem::create_directory(folder / "bench");
  write("bench/spring.csv", "time_s,position_mm,axial_force_N\n");
  for (const char* command : {"campaign size_6 -o bench", "campaign size_6 --truth -o bench"}) {
    const Answer answer = run(command);
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.message, ::testing::HasSubstr("bench/spring.csv: it is there already and comes from no earlier "
                                                     "campaign of the virtual rig; move it"));
  }
  EXPECT_EQ(content("bench/spring.csv"), "time_s,position_mm,axial_force_N\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "bench" / "campaign.toml"));
  write("model.json", "{}");
  EXPECT_THAT(run("demo -o .").message, ::testing::HasSubstr("model.json: it is there already"));
  EXPECT_THAT(run("campaign size_6 -o -").message, ::testing::HasSubstr("name one after -o"));
}

TEST_F(ReadThroughOthers, TwoOutputsDoNotMixOnStandardOutput) {
  write("run.toml", "protocol = \"duty_cycle\"\n[run]\nduration_s = 1\n");
  const Answer answer = run("simulate run.toml -o - --truth -");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, ::testing::HasSubstr("cannot write standard output: another output of this command"));
  EXPECT_EQ(answer.output, "");
}

}  // namespace
}  // namespace spoolflow::apps
