/// What a site keeps until the fleet has it.
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/blocks/block.hpp"
#include "addons/live/tests/temporary_folder.hpp"
#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::fleet {
namespace {

class Outbox : public live::InFolder {
 protected:
  static constexpr std::size_t most_waiting_bytes = 60'000;
  static std::unique_ptr<live::ValveAtWork> valve(const live::OutboxPosition& after) {
    static const live::SharedModel shared{
        std::make_shared<const model::Model>(model::read_model(SPOOLFLOW_EXAMPLES "/live/size_6.json")),
        std::string(64, 'a')};
    auto out = std::make_unique<live::ValveAtWork>("v", shared, "test");
    out->publish("hall/v", after, {.longest_s = 0.25, .waiting_bytes = most_waiting_bytes});
    return out;
  }
  /// A second at 1 kHz.
  static live::SampleBlock second(int number) {
    live::SampleBlock out{.arrived_ns = 1};
    for (int k = 0; k < 1000; ++k) out.samples.push_back({number + 1e-3 * k, 1, 8, 1e-3, 313});
    return out;
  }
};

TEST_F(Outbox, KeepsBlocksUntilTheyAreCovered) {
  live::Store store(path("site.sqlite"));
  const auto session = store.session(1234);
  EXPECT_EQ(session, 1234U);
  const auto at = valve({.valve = "v", .session = session});
  std::vector<live::Event> events;
  for (int k = 0; k < 3; ++k) {
    at->work(second(k));
    store.commit({1000 * k, 1000 * k}, {at->take_commit(false)}, events);
  }
  ASSERT_EQ(store.positions().size(), 1U);
  EXPECT_EQ(store.positions()[0].number, 12U);
  EXPECT_EQ(store.session(99999), session);
  live::Database reader = live::open_store_to_read(path("site.sqlite"));
  std::uint64_t number = 0, samples = 0;
  for (const live::OutboxBlock& one : live::blocks_of(reader, "v", 0, 100)) {
    const auto read = read_block(one.bytes);
    ASSERT_TRUE(std::holds_alternative<Block>(read));
    const Block& block = std::get<Block>(read);
    EXPECT_EQ(block.number, ++number);
    EXPECT_EQ(block.session, session);
    EXPECT_LE(block.samples.back().time_s - block.samples.front().time_s, 0.25);
    samples += block.samples.size();
  }
  EXPECT_EQ(samples, 3000U);
  store.cover({{.valve = "v", .covered = 10}});
  EXPECT_EQ(live::blocks_of(reader, "v", 0, 100).size(), 2U);
  EXPECT_EQ(store.positions()[0].covered, 10U);
  EXPECT_EQ(store.positions()[0].number, 12U);
}

TEST_F(Outbox, SendsAgainWhatCouldNotBeKept) {
  const auto at = valve({.valve = "v", .session = 5, .number = 7});
  at->work(second(0));
  const live::ValveCommit failed = at->take_commit(false);
  at->give_back(failed);
  at->work(second(1));
  const live::ValveCommit next = at->take_commit(false);
  ASSERT_EQ(next.blocks.size(), 8U);
  EXPECT_EQ(next.blocks.front().number, 8U);
  EXPECT_EQ(next.blocks.front().bytes, failed.blocks.front().bytes);
  EXPECT_EQ(next.since_last.samples, 2000);
}

// A disk that is full for an hour: memory holds the newest blocks up to the limit, and their numbers show the gap.
TEST_F(Outbox, BlocksThatTheStoreCannotKeepAreHeldInMemoryUpToTheLimit) {
  const auto at = valve({.valve = "v", .session = 5});
  std::size_t given_up = 0, most = 0;
  const auto bytes = [](const live::ValveCommit& commit) {
    std::size_t out = 0;
    for (const live::OutboxBlock& one : commit.blocks) out += one.bytes.size();
    return out;
  };
  live::ValveCommit commit;
  for (int k = 0; k < 600; ++k) {
    at->work(second(k));
    commit = at->take_commit(false);
    most = std::max(most, bytes(commit));
    given_up += at->give_back(commit);
  }
  const live::ValveCommit left = at->take_commit(false);
  EXPECT_LE(bytes(left), most_waiting_bytes);
  EXPECT_GT(bytes(left), most_waiting_bytes / 2);
  EXPECT_LT(most, 2 * most_waiting_bytes);  // and what came in the last second
  EXPECT_GT(given_up, 0U);
  EXPECT_EQ(left.blocks.front().number, given_up + 1);
  EXPECT_EQ(left.blocks.size() + given_up, 2400U);
  live::Store store(path("site.sqlite"));
  std::vector<live::Event> events;
  store.commit({1000, 1000}, {left}, events);
  EXPECT_EQ(store.positions()[0].number, 2400U);
}

TEST_F(Outbox, GivesUpTheOldestBeyondItsSize) {
  live::Store store(path("site.sqlite"));
  std::vector<live::Event> events;
  live::ValveCommit commit;
  commit.state.valve = "v";
  commit.outbox_session = 1;
  for (std::uint64_t k = 1; k <= 3000; ++k) commit.blocks.push_back({k, std::vector<std::uint8_t>(1000)});
  store.commit({0, 0}, {commit}, events);
  EXPECT_EQ(store.drop_oldest_blocks(10), 0);
  EXPECT_EQ(store.drop_oldest_blocks(2.5), 1000);
  live::Database reader = live::open_store_to_read(path("site.sqlite"));
  EXPECT_EQ(live::blocks_of(reader, "v", 0, 64).front().number, 1001U);  // however many are given up before it
  EXPECT_EQ(live::blocks_of(reader, "v", 0, 64).size(), 64U);
}

}  // namespace
}  // namespace spoolflow::fleet
