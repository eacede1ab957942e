/// How long the blocks of a valve stand, by a clock of the test's own.
#include "addons/fleet/delivery.hpp"

#include <set>

#include <gtest/gtest.h>

namespace spoolflow::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A site, a way that loses all while it is closed, and a fleet that commits each half second, and confirms, the blocks
/// whose turn has come. It asks for nothing.
struct Way {
  Delivery::Time now{seconds(1000)};
  Delivery delivery{1, 0};
  std::uint64_t oldest = 1, newest = 0, committed = 0, handed_over = 0;
  std::set<std::uint64_t> there{};
  bool open = true;

  void tenth() {
    now += milliseconds(100);
    delivery.found(newest);
    const Delivery::Due due = delivery.due(now);
    const std::uint64_t first = std::max(due.after + 1, oldest);
    for (std::uint64_t k = first; k <= newest && k < first + due.most; ++k) {
      delivery.sent(k, now);
      ++handed_over;
      if (open) there.insert(k);
    }
    if (now.time_since_epoch() % milliseconds(500) != milliseconds(0)) return;
    // The oldest that the site has stands for those that it has given up.
    while (!there.empty() && (*there.begin() <= committed + 1 || *there.begin() == oldest)) {
      committed = std::max(committed, *there.begin());
      there.erase(there.begin());
    }
    if (open) (void)delivery.covered(committed, now);
  }
  void run(milliseconds time) {
    for (const Delivery::Time end = now + time; now < end;) tenth();
  }
};

TEST(Delivery, HasAllBlocksThereWithinTenSecondsAfterTheWayIsOpenAgainHoweverLongItWasClosed) {
  for (milliseconds closed{200}; closed < seconds(90); closed += milliseconds(700)) {
    Way way;
    way.newest = 10;
    way.run(seconds(2));
    ASSERT_EQ(way.committed, 10U);
    way.open = false;
    way.newest = 130;
    way.run(closed);
    ASSERT_EQ(way.committed, 10U);
    way.open = true;
    way.run(seconds(10));
    EXPECT_EQ(way.committed, 130U) << closed.count() << " ms closed";
  }
}

TEST(Delivery, DoesNotFloodAFleetThatIsAway) {
  Way way;
  way.open = false;
  way.newest = 1000;
  way.run(seconds(600));
  EXPECT_LE(way.handed_over, 64 + 300U);
}

TEST(Delivery, GoesOnBehindMoreBlocksThatWereGivenUpThanAreUnderWayAtATime) {
  Way way;
  way.oldest = 1001;
  way.newest = 1200;
  way.run(seconds(10));
  EXPECT_EQ(way.committed, 1200U);
}

TEST(Delivery, SendsAtOnceWhatIsAskedFor) {
  Delivery delivery(1, 0);
  const Delivery::Time now{};
  delivery.found(10);
  EXPECT_EQ(delivery.due(now).most, 64U);
  for (std::uint64_t k = 1; k <= 10; ++k) delivery.sent(k, now);
  EXPECT_EQ(delivery.due(now).most, 0U);
  delivery.asked(4);
  EXPECT_EQ(delivery.due(now).after, 3U);
  EXPECT_TRUE(delivery.covered(5, now));
  EXPECT_FALSE(delivery.covered(5, now));
  EXPECT_FALSE(delivery.covered(11, now));  // of a store that is another
}

}  // namespace
}  // namespace spoolflow::fleet
