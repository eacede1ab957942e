/// Producing ahead gives what producing one by one would.
#include "spoolflow/apps/terminal/ahead.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::apps {
namespace {

using ::testing::ElementsAre;

/// 0, 1, 2 … `last`, then the end.
auto counting_to(int last) {
  return [last, k = 0](int& item) mutable {
    item = k;
    return k++ <= last;
  };
}

class ProducedAhead : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(InAThread, ProducedAhead, ::testing::Bool());

TEST_P(ProducedAhead, KeepsTheOrderAndEndsOnce) {
  Ahead<int> numbers(counting_to(999), GetParam());
  int expected = 0;
  while (const int* number = numbers.next()) EXPECT_EQ(*number, expected++);
  EXPECT_EQ(expected, 1000);
}

TEST_P(ProducedAhead, ReportsAFailureAfterWhatCameBeforeIt) {
  Ahead<int> numbers(
      [k = 0](int& item) mutable {
        if (k == 3) throw std::runtime_error("the fourth");
        item = k++;
        return true;
      },
      GetParam());
  std::vector<int> taken;
  const auto take_all = [&] {
    while (const int* number = numbers.next()) taken.push_back(*number);
  };
  EXPECT_THROW(take_all(), std::runtime_error);
  EXPECT_THAT(taken, ElementsAre(0, 1, 2));
}

TEST_P(ProducedAhead, LeavesAnItemAloneUntilTheNextIsAskedFor) {
  Ahead<int> numbers(counting_to(50), GetParam());
  const int* number = numbers.next();
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(*number, 0);
}

TEST_P(ProducedAhead, StepsFollowOneAnother) {
  Ahead<int> numbers(counting_to(99), GetParam());
  Ahead<int> squares(
      [&](int& item) {
        const int* number = numbers.next();
        if (number != nullptr) item = *number * *number;
        return number != nullptr;
      },
      GetParam());
  int expected = 0;
  while (const int* square = squares.next()) {
    EXPECT_EQ(*square, expected * expected);
    ++expected;
  }
  EXPECT_EQ(expected, 100);
}

TEST(ProducedInAThread, StopsWhenNobodyTakesAnyMore) {
  std::atomic<int> produced{0};
  {
    Ahead<int> endless(
        [&](int& item) {
          item = produced++;
          return true;
        },
        true);
    EXPECT_EQ(*endless.next(), 0);
  }
  EXPECT_LE(produced, 5);
}

}  // namespace
}  // namespace spoolflow::apps
