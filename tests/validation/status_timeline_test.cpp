#include "spoolflow/validation/status_timeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

using sensor::Status;

TEST(StatusTimeline, ShowsWhenAndHowOften) {
  std::vector<double> time_s;
  std::vector<Status> status;
  for (int k = 0; k < 1000; ++k) {
    time_s.push_back(k * 0.01);
    status.push_back((k < 250 ? Status::closed : Status::none) | (k == 700 ? Status::position_fault : Status::none));
  }
  const std::vector<StatusRow> rows = status_rows(time_s, status, 100);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].name, "closed");
  EXPECT_FALSE(rows[0].fault);
  EXPECT_DOUBLE_EQ(rows[0].share, 0.25);
  ASSERT_FALSE(rows[0].spans.empty());
  EXPECT_DOUBLE_EQ(rows[0].spans.front().from_s, 0);
  EXPECT_NEAR(rows[0].spans.back().to_s, 2.5, 0.11);
  EXPECT_EQ(rows[1].name, "position_fault");
  EXPECT_TRUE(rows[1].fault);
  ASSERT_EQ(rows[1].spans.size(), 1U);  // one sample of a thousand still shows
  EXPECT_NEAR(rows[1].spans.front().from_s, 7.0, 0.11);
}

TEST(StatusTimeline, HasASentenceForEveryStatus) {
  for (const sensor::StatusName& entry : sensor::status_names) {
    EXPECT_THAT(meaning(entry.bit), ::testing::EndsWith(".")) << entry.name;
  }
}

TEST(StatusTimeline, OfASingleSampleIsThatSample) {
  const std::vector<StatusRow> rows = status_rows(std::vector{1.0}, std::vector{Status::sample_missing}, 100);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_DOUBLE_EQ(rows.front().share, 1.0);
  EXPECT_TRUE(status_rows({}, {}, 100).empty());
}

}  // namespace
}  // namespace spoolflow::validation
