/// What a site makes of a fleet that commits nothing, by a clock of the test's own.
#include "addons/fleet/standstill.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fleet {
namespace {

using std::chrono::seconds;
using News = Standstill::News;

TEST(Standstill, BeginsOnceAMinuteAfterTheLastCommitAndEndsWithTheNext) {
  Standstill fleet;
  Standstill::Time now{seconds(1000)};
  EXPECT_EQ(fleet.look(true, now), News::none);
  EXPECT_EQ(fleet.look(true, now += seconds(59)), News::none);
  EXPECT_EQ(fleet.look(true, now += seconds(1)), News::begins);
  EXPECT_EQ(fleet.look(true, now += seconds(600)), News::none);
  fleet.committed(now += seconds(1));
  EXPECT_EQ(fleet.look(true, now), News::ends);
  EXPECT_EQ(fleet.look(true, now += seconds(59)), News::none);
}

TEST(Standstill, IsNoneWhileNothingWaitsOrTheFleetIsAway) {
  Standstill fleet;
  Standstill::Time now{seconds(1000)};
  for (int k = 0; k < 100; ++k) EXPECT_EQ(fleet.look(false, now += seconds(10)), News::none);
  EXPECT_EQ(fleet.look(true, now += seconds(1)), News::none);
  fleet.away();
  EXPECT_EQ(fleet.look(true, now += seconds(500)), News::none);
  EXPECT_EQ(fleet.look(true, now += seconds(60)), News::begins);
  fleet.away();
  EXPECT_EQ(fleet.look(true, now += seconds(500)), News::none) << "nothing was committed yet";
}

}  // namespace
}  // namespace spoolflow::fleet
