#include "addons/live/history/state_change.hpp"

#include <random>

#include <gtest/gtest.h>

namespace spoolflow::live {
namespace {

std::vector<std::byte> noise(std::size_t length, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::byte> out(length);
  for (std::byte& each : out) each = static_cast<std::byte>(random());
  return out;
}

TEST(StateChange, OfEqualStatesIsNothing) {
  EXPECT_TRUE(state_change(noise(1000, 1), noise(1000, 1)).empty());
  EXPECT_TRUE(state_change({}, std::vector<std::byte>(1000)).empty());
  EXPECT_TRUE(state_change({}, {}).empty());
}

TEST(StateChange, HasTheWordsThatDifferAlone) {
  const auto before = noise(8000, 1);
  auto now = before;
  now[4000] ^= std::byte{1};
  EXPECT_LE(state_change(before, now).size(), 8U + 3U);
}

TEST(StateChange, MakesTheLaterStateOfTheEarlier) {
  for (const std::size_t length : {1U, 7U, 8U, 9U, 1000U, 4093U}) {
    const auto before = noise(length, 1);
    for (unsigned seed = 0; seed < 20; ++seed) {
      auto now = before;
      std::mt19937 random(seed);
      for (unsigned k = 0; k < seed; ++k) now[random() % length] = static_cast<std::byte>(random());
      auto state = before;
      ASSERT_TRUE(apply_change(state_change(before, now), state));
      ASSERT_EQ(state, now);
      std::vector<std::byte> from_nothing(length);
      ASSERT_TRUE(apply_change(state_change({}, now), from_nothing));
      ASSERT_EQ(from_nothing, now);
    }
  }
}

TEST(StateChange, OfAllValvesAreOnePiece) {
  const StateChanges changes{{1, noise(10, 1)}, {2, {}}, {900, noise(5000, 2)}};
  EXPECT_EQ(parted(joined(changes)), changes);
  auto cut = joined(changes);
  cut.pop_back();
  EXPECT_EQ(parted(cut).size(), 2U);  // the last is damaged
  EXPECT_TRUE(parted({}).empty());
}

TEST(StateChange, DamagedOnesAreRefusedOrHarmless) {
  const auto before = noise(900, 1);
  const auto change = state_change(before, noise(900, 2));
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    auto damaged = change;
    damaged.resize(random() % (change.size() + 1));
    for (int k = 0; k < 3 && !damaged.empty(); ++k)
      damaged[random() % damaged.size()] = static_cast<std::byte>(random());
    auto state = before;
    (void)apply_change(damaged, state);  // under the sanitizers: nothing outside is read or written
    EXPECT_EQ(state.size(), before.size());
  }
  const std::vector<std::byte> far{std::byte{0xFF}, std::byte{0xFF}, std::byte{0x7F}, std::byte{1}};
  auto state = before;
  EXPECT_FALSE(apply_change(far, state));
}

}  // namespace
}  // namespace spoolflow::live
