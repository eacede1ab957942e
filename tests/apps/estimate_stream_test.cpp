/// `estimate -`: a source that runs on, sample after sample, through a real pipe.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"
#include "tests/apps/running_command.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* stream_header = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";

std::string stream_sample(int k) {
  return fmt::format("{:.3f},1.500,4.8,1.000,50\n", 0.001 * k);
}

class EstimateStream : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "model.json");
  }
};

// The next sample is sent only when the row of this one was read: with any row held back the test would stand still.
TEST_F(EstimateStream, AnswersEachSampleBeforeTheNextComes) {
  RunningCommand estimate(folder, {"estimate", "model.json", "-", "-o", "-"});
  estimate.send(stream_header);
  for (int k = 0; k < 50; ++k) {
    estimate.send(stream_sample(k));
    const std::string line = k == 0 ? estimate.output_line() : std::string("time_s,");
    EXPECT_THAT(line, StartsWith("time_s,"));
    ASSERT_THAT(estimate.output_line(), StartsWith(fmt::format("{:.6f},", 0.001 * k)));
  }
  estimate.close_input();
  EXPECT_EQ(estimate.wait(), 0);
}

TEST_F(EstimateStream, ALineThatCameInPiecesIsOneSample) {
  RunningCommand estimate(folder, {"estimate", "model.json", "-", "-o", "-"});
  estimate.send("time_s,curr");
  estimate.send("ent_A,position_mm\n0.0");
  estimate.send("00,1.5,1.0\n0.00");
  EXPECT_THAT(estimate.output_line(), StartsWith("time_s,"));
  EXPECT_THAT(estimate.output_line(), StartsWith("0.000000,"));
  estimate.send("1,1.5,1.");
  estimate.send("0\n");
  EXPECT_THAT(estimate.output_line(), StartsWith("0.001000,"));
}

TEST_F(EstimateStream, HoldsOverWhatIsNoSampleAndGoesOn) {
  RunningCommand estimate(folder, {"estimate", "model.json", "-", "-o", "-"});
  const auto answer = [&](const std::string& line) {
    estimate.send(line);
    return estimate.output_line();
  };
  estimate.send(stream_header);
  const std::string first = answer(stream_sample(0));
  EXPECT_THAT(first, StartsWith("time_s,"));
  std::string before = estimate.output_line();
  for (int k = 1; k < 10; ++k) before = answer(stream_sample(k));
  const std::string flow = before.substr(before.find(','), before.find(',', before.find(',') + 1) - before.find(','));
  EXPECT_THAT(answer("0.010,NaN,4.8,1.000,50\n"), AllOf(StartsWith("0.010000" + flow), EndsWith("sample_missing")));
  EXPECT_THAT(answer("0.011,1.5,4.8,what?,50\n"), AllOf(StartsWith("0.011000" + flow), HasSubstr("sample_missing")));
  EXPECT_THAT(answer("0.011,1.5,4.8,1.0,50\n"), AllOf(StartsWith("0.011000"), HasSubstr("time_fault")));
  EXPECT_THAT(answer("0.005,1.5,4.8,1.0,50\n"), AllOf(StartsWith("0.005000"), HasSubstr("time_fault")));
  EXPECT_THAT(answer("nan,1.5,4.8,1.0,50\n"), AllOf(StartsWith(","), HasSubstr("time_fault")));
  EXPECT_THAT(answer(std::string("0.1,1\0\n1,2,3,4,5,6,7\n", 21) + stream_sample(12)), StartsWith("0.012000"));
  estimate.close_input();
  EXPECT_EQ(estimate.wait(), 0);
  std::string messages;
  for (std::string line = estimate.message_line(); !line.empty(); line = estimate.message_line())
    messages += line + '\n';
  EXPECT_THAT(messages, HasSubstr("1 samples have no time stamp, of 1 it runs back"));
  EXPECT_THAT(messages, HasSubstr("2 lines are no samples"));
}

TEST_F(EstimateStream, AnswersAsFromAFileAndAFileWhoseTimeRunsBackIsRefused) {
  std::string text = stream_header;
  for (int k = 0; k < 3000; ++k) text += stream_sample(k);
  write("run.csv", text);
  EXPECT_EQ(run("estimate model.json run.csv -o file.csv").status, 0);
  RunningCommand estimate(folder, {"estimate", "model.json", "-", "-o", "stream.csv"});
  for (std::size_t at = 0; at < text.size(); at += 1000) estimate.send(std::string_view(text).substr(at, 1000));
  estimate.close_input();
  EXPECT_EQ(estimate.wait(), 0);
  EXPECT_EQ(content("stream.csv"), content("file.csv"));
  write("back.csv", text + stream_sample(0));
  EXPECT_EQ(run("estimate model.json back.csv -o back_out.csv").status, 2);
}

TEST_F(EstimateStream, AHeaderThatCannotBeUsedEndsIt) {
  RunningCommand estimate(folder, {"estimate", "model.json", "-", "-o", "-"});
  estimate.send("time_s,current_A\n0,1\n");
  EXPECT_EQ(estimate.wait(), 2);
  EXPECT_THAT(estimate.message_line(), HasSubstr("position"));
}

}  // namespace
}  // namespace spoolflow::apps
