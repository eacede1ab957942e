#include "addons/live/sources/intake.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace spoolflow::live {
namespace {

SampleBlock intake_block(std::size_t samples, std::uint64_t next = 0) {
  return {.samples = std::vector<estimation::TimedSample>(samples), .after = {.next = next}};
}

TEST(Intake, DropsWhatFindsNoRoomAndCountsIt) {
  int calls = 0;
  Intake intake([&] { ++calls; });
  intake.push(intake_block(Intake::most_samples - 10, 1));
  intake.push(intake_block(11, 2));
  intake.push(intake_block(10, 3));
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(intake.counters().received, Intake::most_samples + 11);
  EXPECT_EQ(intake.counters().dropped, 11U);
  std::vector<SampleBlock> blocks;
  intake.take(blocks);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[1].after.next, 3U);
  intake.push(intake_block(1));
  EXPECT_EQ(calls, 2);
}

TEST(Intake, ASourceThatCanWaitLosesNothing) {
  Intake intake([] {});
  std::jthread source([&](const std::stop_token& stop) {
    for (int k = 0; k < 10; ++k) EXPECT_TRUE(intake.push_waiting(intake_block(Intake::most_samples / 2), stop));
  });
  std::size_t taken = 0;
  std::vector<SampleBlock> blocks;
  while (taken < 5 * Intake::most_samples) {
    intake.take(blocks);
    for (const SampleBlock& block : blocks) taken += block.samples.size();
    std::this_thread::yield();
  }
  EXPECT_EQ(intake.counters().dropped, 0U);
}

TEST(Intake, AStopEndsTheWait) {
  Intake intake([] {});
  intake.push(intake_block(Intake::most_samples));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(intake.push_waiting(intake_block(1), stop.get_token()));
}

}  // namespace
}  // namespace spoolflow::live
