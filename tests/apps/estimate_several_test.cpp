/// `spoolflow estimate` of several recordings at once.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class EstimateSeveral : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    for (int k = 0; k < 5; ++k) write(fmt::format("run{}.csv", k), strokes(k));
  }

  /// Two seconds of a spool that goes to and fro, each recording at a pace of its own.
  static std::string strokes(int pace) {
    std::string text = "time_s,current_A,position_mm\n";
    for (int k = 0; k < 2000; ++k) {
      const double swing = std::sin(0.002 * (pace + 1) * k);
      text += fmt::format("{:.3f},{:.4f},{:.5f}\n", 1e-3 * k, 1.2 + 0.5 * swing, 1.1 + 0.9 * swing);
    }
    return text;
  }
  const std::string model = SPOOLFLOW_EXAMPLE_MODEL;
};

TEST_F(EstimateSeveral, AnswersAsEachAloneWould) {
  const std::string two_packed =
      SPOOLFLOW_EXAMPLES "/valve_a/duty_cycle_1.h5 " SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5";
  const Answer answer =
      run("estimate " + model + " run0.csv run1.csv " + two_packed + " run2.csv run3.csv run4.csv -o together");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, AllOf(HasSubstr("run0.csv: 2000 samples"), Not(HasSubstr("doubt"))));
  for (const std::string name : {"run0", "run1", "run2", "run3", "run4"}) {
    ASSERT_EQ(run("estimate -q " + model + " " + name + ".csv -o alone.csv").status, 0);
    EXPECT_EQ(content("together/" + name + ".csv"), content("alone.csv")) << name;
  }
  for (const std::string name : {"duty_cycle_1", "ramp_60bar"}) {
    ASSERT_EQ(run("estimate -q " + model + " " SPOOLFLOW_EXAMPLES "/valve_a/" + name + ".h5 -o alone.csv").status, 0);
    EXPECT_EQ(content("together/" + name + ".csv"), content("alone.csv")) << name;
  }
}

TEST_F(EstimateSeveral, SaysOnceThatABandOfBenchConditionsKnowsNothingOfAMachine) {
  const auto note = HasSubstr("--environment machine");
  const Answer answer = run("estimate " + model + " run0.csv run1.csv -o together");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, note);
  EXPECT_EQ(answer.message.find("--environment"), answer.message.rfind("--environment"));
  for (const std::string declared : {"--environment machine", "--environment bench", "--estimator condensed", "-q"})
    EXPECT_THAT(run("estimate " + model + " run0.csv -o alone.csv " + declared).message, Not(note)) << declared;
}

TEST_F(EstimateSeveral, FinishesTheOthersWhereOneIsDamaged) {
  write("run1.csv", "time_s,current_A,position_mm\n0,1,1\n0.001,one,1\n");
  const Answer answer = run("estimate " + model + " run0.csv run1.csv run2.csv -o together");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("run1.csv"));
  EXPECT_THAT(content("together/run0.csv"), Not(IsEmpty()));
  EXPECT_THAT(content("together/run2.csv"), Not(IsEmpty()));
  EXPECT_FALSE(std::filesystem::exists(folder / "together/run1.csv"));
}

TEST_F(EstimateSeveral, ReportsEveryFailureOfSeveral) {
  write("run1.csv", "time_s,current_A,position_mm\n0,1,1\n0.001,one,1\n");
  write("run3.csv", "time_s,position_mm\n0,1\n0.001,1\n");
  const Answer answer = run("estimate " + model + " run0.csv run1.csv run2.csv run3.csv missing.csv -o together");
  EXPECT_EQ(answer.status, 2);
  for (const std::string name : {"run1.csv", "run3.csv", "missing.csv"})
    EXPECT_THAT(answer.message, HasSubstr("spoolflow estimate: " + name)) << name;
  EXPECT_THAT(content("together/run0.csv"), Not(IsEmpty()));
  EXPECT_THAT(content("together/run2.csv"), Not(IsEmpty()));
}

TEST_F(EstimateSeveral, RefusesTwoOfOneNameAndStandardStreams) {
  std::filesystem::create_directory(folder / "other");
  write("other/run0.csv", strokes(0));
  EXPECT_THAT(run("estimate " + model + " run0.csv other/run0.csv -o together").message, HasSubstr("other/run0.csv"));
  EXPECT_EQ(run("estimate " + model + " run0.csv - -o together < run1.csv").status, 2);
  EXPECT_EQ(run("estimate " + model + " run0.csv run1.csv -o -").status, 2);
  EXPECT_EQ(run("estimate " + model + " run0.csv run1.csv -o both.csv").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "both.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "together"));
  // The recordings themselves are no place for their estimates.
  EXPECT_EQ(run("estimate " + model + " run0.csv run1.csv -o .").status, 2);
  EXPECT_EQ(content("run0.csv"), strokes(0));
}

}  // namespace
}  // namespace spoolflow::apps
