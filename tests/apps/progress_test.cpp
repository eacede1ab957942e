#include "spoolflow/apps/terminal/progress.hpp"

#include <gtest/gtest.h>

namespace spoolflow::apps {
namespace {

TEST(Progress, SaysShareRateAndTimeLeft) {
  const std::string line = progress_line({.task = "estimating", .share = 0.25, .samples = 3'000'000, .elapsed_s = 2.0});
  EXPECT_EQ(line, "estimating  25 % [####            ]  1.5 M samples/s  0:06 left");
}

TEST(Progress, LeavesOutWhatNobodyKnowsOfAPipe) {
  const std::string line =
      progress_line({.task = "estimating", .share = std::nullopt, .samples = 12'300, .elapsed_s = 10.0});
  EXPECT_EQ(line, "estimating  12.3 k samples  1.2 k samples/s");
}

TEST(Progress, SpeaksOfHoursWhereThereAreAny) {
  const std::string line = progress_line({.task = "calibrating", .share = 0.5, .elapsed_s = 3725.0});
  EXPECT_EQ(line, "calibrating  50 % [########        ]  1:02:05 left");
}

TEST(Progress, FitsATerminalOf80Columns) {
  const std::string line =
      progress_line({.task = std::string(20, 'x'), .share = 0.999, .samples = 999'949'999'999, .elapsed_s = 1.0e-3});
  EXPECT_LE(line.size(), 79u);
}

TEST(Progress, ClampsAShareThatOvershoots) {
  EXPECT_EQ(progress_line({.task = "t", .share = 1.01, .elapsed_s = 5.0}), "t 100 % [################]  0:00 left");
}

}  // namespace
}  // namespace spoolflow::apps
