/// A spool that its open stop holds while the current goes on rising is named; one that springs and friction hold is
/// not.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/plausibility/run_relations.hpp"
#include "tests/plausibility/rig_benches.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

/// What is said of a valve's slow stroke to full opening whose position goes no further than that share of its way.
std::string said_of(double way_share, bool stop_is_known = false) {
  const RigBenches& valve = rig_benches("size_6", 33);
  KnownValve known = known_valve(valve.benches());
  known.open_stop_is_known = stop_is_known;
  recording::Recording run = *valve.benches().operation.front();
  std::vector<double>& position_m = run.column(Channel::position);
  const double end_m = way_share * std::ranges::max(position_m);
  for (double& each_m : position_m) each_m = std::min(each_m, end_m);
  return undeclared_open_stop(known, block_means(run, 2000));
}

TEST(OpenStop, IsNamedWhereTheSpoolStandsAndTheSolenoidPullsOn) {
  EXPECT_THAT(said_of(0.6), testing::ContainsRegex("its open stop; without \\[valve\\] open_stop_mm = 1\\."));
  EXPECT_THAT(said_of(0.6, true), testing::IsEmpty());
}

TEST(OpenStop, IsNoneOfASpoolThatSpringsAndFrictionHold) {
  EXPECT_THAT(said_of(1), testing::IsEmpty());
}

}  // namespace
}  // namespace spoolflow::plausibility
