#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/monitor/adaptation.hpp"

namespace spoolflow::monitor {
namespace {

/// Looked at each month, or as the days say; wear that goes on at an even pace.
model::Provenance worn_over(const std::vector<int>& days) {
  model::Provenance out;
  out.created = "2026-01-01T00:00:00Z";
  for (const int day : days) {
    model::Adaptation look{"1", "", std::string(64, 'a'), {}, {}};
    const std::time_t time = 1767225600 + 86400 * day;
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
    look.created = text;
    look.wear = model::WearState{0.01 / 30 * day, 1 + 0.03 / 30 * day, 1.5e-6 / 30 * day, 0.01, 0.05};
    out.adaptations.push_back(look);
  }
  return out;
}

TEST(WearDrift, IsThePaceOfWearWithABandThatNarrowsWithTheLooks) {
  const WearDrift year = wear_drift(worn_over({30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330})).value();
  EXPECT_NEAR(year.edge_width.value, 0.01, 1e-6);
  EXPECT_NEAR(year.friction.value, 0.03, 1e-6);
  EXPECT_NEAR(year.position_zero_m.value, 1.5e-6, 1e-10);
  EXPECT_EQ(year.looks, 11U);
  EXPECT_LT(year.edge_width.uncertainty_95, 0.01);
  const WearDrift quarter = wear_drift(worn_over({30, 60, 90})).value();
  EXPECT_GT(quarter.edge_width.uncertainty_95, 2 * year.edge_width.uncertainty_95);
  EXPECT_THAT(text_of(year), testing::HasSubstr("edge width +1 +- 0."));
}

TEST(WearDrift, IsNotStatedOfAValveThatNobodyLookedAtOrOnlyAtOnce) {
  EXPECT_FALSE(wear_drift(worn_over({})));
  EXPECT_FALSE(wear_drift(worn_over({0, 0})));
  model::Provenance monitored = worn_over({30});
  monitored.adaptations[0].wear.reset();  // by the monitor, not by references
  EXPECT_FALSE(wear_drift(monitored));
}

TEST(WearDrift, OfAWholeValveIsThatOfEachDirectionByItself) {
  model::Model valve{};
  valve.p_to_a.emplace();
  valve.provenance = worn_over({30, 60, 90});
  const std::size_t looks = valve.provenance.adaptations.size();
  for (std::size_t k = 0; k < looks; ++k) {
    model::Adaptation& of_b = valve.provenance.adaptations[k];
    of_b.direction = "b";
    model::Adaptation of_a = of_b;
    of_a.direction = "a";
    of_a.wear->edge_width *= 2;
    valve.provenance.adaptations.push_back(of_a);
  }
  const std::vector<std::string> drifts = drift_texts(valve);
  ASSERT_EQ(drifts.size(), 2U);
  EXPECT_THAT(drifts[0], testing::HasSubstr("P to B in 30 days: edge width +1 +- "));
  EXPECT_THAT(drifts[1], testing::HasSubstr("P to A in 30 days: edge width +2 +- "));
}

}  // namespace
}  // namespace spoolflow::monitor
