#include "spoolflow/apps/terminal/output_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <signal.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/apps/terminal/interruption.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OutputFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "spoolflow-output-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  [[nodiscard]] static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }
  [[nodiscard]] auto files() const { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }

  template <class Action>
  [[nodiscard]] static std::string refusal(Action action) {
    try {
      action();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "not refused";
  }

  fs::path folder;
};
using OutputFileDeathTest = OutputFileTest;

TEST_F(OutputFileTest, AppearsUnderItsNameOnlyOnCommit) {
  const fs::path target = folder / "estimate.csv";
  OutputFile output(target);
  output.stream() << "time_s,flow_L_min\n" << 0.5 << ',' << 12;
  EXPECT_FALSE(fs::exists(target));
  output.commit();
  EXPECT_EQ(content(target), "time_s,flow_L_min\n0.5,12");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, LeavesWhatStoodThereWhenTheWorkFails) {
  const fs::path target = folder / "model.json";
  write(target, "old");
  {
    OutputFile output(target);
    output.stream() << std::string(1 << 20, 'x');
  }
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, CarriesEveryByteAcrossItsBuffer) {
  std::string text;
  for (int i = 0; text.size() < 1'500'000; ++i) text += std::to_string(i) + ',';
  OutputFile output(folder / "long.csv");
  for (std::size_t at = 0; at < text.size(); at += 997) output.stream() << text.substr(at, 997);
  output.commit();
  EXPECT_EQ(content(folder / "long.csv"), text);
}

TEST_F(OutputFileTest, KeepsTheRightsOfTheFileThatItReplaces) {
  const fs::path target = folder / "model.json";
  write(target, "old");
  ASSERT_EQ(::chmod(target.c_str(), 0640), 0);
  OutputFile output(target);
  output.stream() << "new";
  output.commit();
  EXPECT_EQ(fs::status(target).permissions(), fs::perms(0640));
}

TEST_F(OutputFileTest, WritesThroughALinkAndKeepsIt) {
  write(folder / "real.json", "old");
  fs::create_symlink(folder / "real.json", folder / "link.json");
  OutputFile output(folder / "link.json");
  output.stream() << "new";
  output.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
  EXPECT_EQ(content(folder / "real.json"), "new");
}

TEST_F(OutputFileTest, LeavesADeviceADevice) {
  OutputFile output("/dev/null");
  output.stream() << "nothing";
  output.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFileTest, NamesTheFolderThatIsNotThere) {
  const fs::path target = folder / "nowhere" / "estimate.csv";
  const std::string message = refusal([&] { OutputFile output(target); });
  EXPECT_THAT(message, HasSubstr(target.string()));
  EXPECT_THAT(message, HasSubstr((folder / "nowhere").string() + " does not exist"));
}

TEST_F(OutputFileTest, RefusesAFolderAsItsTarget) {
  EXPECT_THAT(refusal([&] { OutputFile output(folder); }), HasSubstr("it is a folder"));
  EXPECT_THAT(refusal([&] { OutputFile output(folder / ""); }), HasSubstr("it is a folder"));
  EXPECT_THAT(refusal([&] { OutputFile output(""); }), HasSubstr("no name"));
}

TEST_F(OutputFileTest, RefusesAFileInsteadOfAFolderOnTheWay) {
  write(folder / "file", "");
  EXPECT_THAT(refusal([&] { OutputFile output(folder / "file" / "x.csv"); }), HasSubstr("is not a folder"));
}

TEST_F(OutputFileTest, RefusesToReplaceItsOwnInputUnderAnyName) {
  const fs::path input = folder / "run.csv";
  write(input, "data");
  fs::create_symlink(input, folder / "alias.csv");
  for (const fs::path& target : {input, folder / "alias.csv", folder / "." / "run.csv"}) {
    EXPECT_THAT(refusal([&] { OutputFile output(target, {"-", input}); }), HasSubstr("the same file"));
  }
  EXPECT_EQ(content(input), "data");
}

TEST_F(OutputFileTest, RefusesTwoOutputsOfOneNameBeforeEitherExists) {
  EXPECT_THAT(refusal([&] { OutputFile output(folder / "a", {folder / "b" / ".." / "a"}); }),
              HasSubstr("the same file"));
}

TEST_F(OutputFileTest, StandardOutputIsOfOneOutputAtATime) {
  {
    const OutputFile figures("-");
    EXPECT_THAT(refusal([&] { OutputFile page("-"); }), HasSubstr("cannot write standard output: another output of"));
  }
  EXPECT_NO_THROW(OutputFile("-"));
}

TEST_F(OutputFileTest, KeepsWhatAnotherWroteIntoTheFolder) {
  std::ofstream(folder / "spring.csv") << "measured";
  EXPECT_THAT(
      refusal([&] {
        keep_what_is_there(folder, {"ramp.csv", "spring.csv"}, "campaign");
      }),
      HasSubstr("spring.csv: it is there already and comes from no earlier campaign; move it, or name another"));
  EXPECT_NO_THROW(keep_what_is_there(folder, {"ramp.csv"}, "campaign"));
}

TEST_F(OutputFileTest, SaysThatTheDiskIsFull) {
  OutputFile output("/dev/full");
  output.stream() << "short";
  EXPECT_THAT(refusal([&] { output.commit(); }), HasSubstr("the disk is full"));
  OutputFile longer("/dev/full");
  EXPECT_THAT(refusal([&] { longer.stream() << std::string(1 << 20, 'x'); }), HasSubstr("the disk is full"));
}

// Permission means nothing to root: as root this runs as nobody.
TEST_F(OutputFileTest, SaysThatItMayNotWriteThere) {
  write(folder / "protected.csv", "old");
  ASSERT_EQ(::chmod((folder / "protected.csv").c_str(), 0444), 0);
  ASSERT_EQ(::chmod(folder.c_str(), 0555), 0);
  const uid_t self = ::geteuid();
  if (self == 0) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string fresh = refusal([&] { OutputFile output(folder / "new.csv"); });
  const std::string existing = refusal([&] { OutputFile output(folder / "protected.csv"); });
  if (self == 0) {
    ASSERT_EQ(::seteuid(self), 0);
  }
  ASSERT_EQ(::chmod(folder.c_str(), 0755), 0);
  EXPECT_THAT(fresh, HasSubstr("no permission to write in the folder " + folder.string()));
  EXPECT_THAT(existing, HasSubstr("write-protected"));
}

TEST_F(OutputFileTest, MakesAnOutputFolderWithItsParents) {
  make_output_folder(folder / "out" / "demo");
  make_output_folder(folder / "out" / "demo");
  EXPECT_TRUE(fs::is_directory(folder / "out" / "demo"));
  write(folder / "file", "");
  EXPECT_THAT(refusal([&] { make_output_folder(folder / "file"); }), HasSubstr("a file of that name"));
  EXPECT_THAT(refusal([&] { make_output_folder(folder / "file" / "demo"); }), HasSubstr("cannot make the folder"));
}

TEST_F(OutputFileDeathTest, RemovesTheUnfinishedFileOnCtrlC) {
  const fs::path target = folder / "estimate.csv";
  write(target, "old");
  const auto interrupted = [&] {
    end_cleanly_when_interrupted("spoolflow");
    interruption_speaker("spoolflow estimate");
    OutputFile output(target);
    output.stream() << std::string(1 << 20, 'x') << std::flush;
    ::raise(SIGINT);
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(130), "spoolflow estimate: interrupted; nothing was written\n");
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileDeathTest, SaysThatAnEarlierFileWasFinishedWhenTerminated) {
  const auto interrupted = [&] {
    end_cleanly_when_interrupted("spoolflow validate");
    OutputFile report(folder / "report.html", {}), figures(folder / "figures.json", {});
    report.stream() << "report";
    report.commit();
    ::raise(SIGTERM);
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(143), "only the files finished before were written");
  EXPECT_EQ(content(folder / "report.html"), "report");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileDeathTest, TurnsTheSizeLimitIntoAMessage) {
  const fs::path target = folder / "estimate.csv";
  const auto limited = [&] {
    end_cleanly_when_interrupted("spoolflow");
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    fmt::print(stderr, "{}\n", refusal([&] {
                 OutputFile output(target);
                 output.stream() << std::string(1 << 20, 'x');
               }));
    ::_exit(0);
  };
  EXPECT_EXIT(limited(), ::testing::ExitedWithCode(0), "grew past the size limit");
  EXPECT_EQ(files(), 0);
}

TEST_F(OutputFileDeathTest, SeparatesAClosedPipeFromAFailure) {
  const auto closed = [] {
    end_cleanly_when_interrupted("spoolflow");
    int ends[2];
    if (::pipe(ends) != 0 || ::dup2(ends[1], STDOUT_FILENO) < 0 || ::close(ends[0]) != 0) ::_exit(3);
    try {
      OutputFile output("-");
      output.stream() << "row";
      output.commit();
    } catch (const ReaderGone&) {
      ::_exit(0);
    }
    ::_exit(4);
  };
  EXPECT_EXIT(closed(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace spoolflow::apps
