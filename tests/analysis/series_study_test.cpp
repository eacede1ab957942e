#include "spoolflow/analysis/series_study.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/calibration/type/type_model.hpp"

namespace spoolflow::analysis {
namespace {

TEST(SeriesStudy, CountsRefusedUnitsAndNothingOfTheirFigures) {
  SeriesStudy study;
  for (const double share : {0.90, 0.94, 0.98}) {
    SeriesStudyUnit unit{study.units.size(), {}};
    for (SeriesJudged& judged : unit.by) judged.runs.fill({share / 10, share, share, 0.1});
    study.units.push_back(unit);
  }
  study.units.back().by[static_cast<std::size_t>(KnownBy::minute)].refusal = "too far from the type";
  EXPECT_EQ(study.refused(KnownBy::type), 0U);
  EXPECT_EQ(study.refused(KnownBy::minute), 1U);
  EXPECT_DOUBLE_EQ(study.over_units(KnownBy::type, 0, &SeriesFigures::largest).median, 0.94);
  EXPECT_DOUBLE_EQ(study.over_units(KnownBy::minute, 0, &SeriesFigures::largest).median, 0.92);
  EXPECT_NEAR(study.over_units(KnownBy::type, 0, &SeriesFigures::largest).low, 0.904, 1e-12);
  EXPECT_NEAR(study.over_units(KnownBy::type, 0, &SeriesFigures::largest).high, 0.976, 1e-12);
  EXPECT_DOUBLE_EQ(study.holding(KnownBy::type, 1), 2.0 / 3);
  EXPECT_DOUBLE_EQ(study.holding(KnownBy::minute, 1), 0.5);
  for (SeriesStudyUnit& unit : study.units) unit.by.front().refusal = "no";
  EXPECT_TRUE(std::isnan(study.over_units(KnownBy::type, 0, &SeriesFigures::p95).median));
}

/// Two units with little of a campaign, which take half a minute: not for every day (ci/long.sh).
TEST(SeriesStudy, DISABLED_AMinuteKnowsUnitsBetterThanTheirTypeWhateverTheThreadsAndInterruptions) {
  const model::Model type =
      calibration::type_model(model::read_model(SPOOLFLOW_SIZE_6_MODEL), calibration::tolerances_from({}));
  rig::ValveAndCampaign asked = rig::read_valve_and_campaign("size_6");
  asked.campaign.oil_temperatures_C = {40, 60};
  asked.campaign.pressure_differences_bar = {20, 45, 70};
  asked.campaign.ramp_rate_percent_per_s = 20;
  std::string saved;
  StudyWork work{.identity = "1", .workers = 2};
  work.saving_interval_s = 0;
  work.save = [&](const std::string& text) {
    if (saved.empty()) saved = text;
  };
  const SeriesStudy whole = series_study(type, "type.json", asked, 2, 7, work);
  const SeriesStudy resumed = series_study(type, "type.json", asked, 2, 7, {.identity = "1", .saved = saved});
  ASSERT_FALSE(saved.empty());
  ASSERT_EQ(resumed.units.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(resumed.units[k].spread_seed, whole.units[k].spread_seed);
    for (const KnownBy by : all_known_by) {
      EXPECT_EQ(whole.units[k].judged(by).refusal, "") << name(by);
      for (std::size_t run = 0; run < series_runs; ++run) {
        EXPECT_EQ(resumed.units[k].judged(by).runs[run].p95, whole.units[k].judged(by).runs[run].p95);
        EXPECT_EQ(resumed.units[k].judged(by).runs[run].band_width, whole.units[k].judged(by).runs[run].band_width);
      }
    }
  }
  const auto median = [&](KnownBy by, double SeriesFigures::*figure) { return whole.over_units(by, 0, figure).median; };
  EXPECT_LT(median(KnownBy::minute, &SeriesFigures::band_width), median(KnownBy::strokes, &SeriesFigures::band_width));
  EXPECT_LT(median(KnownBy::strokes, &SeriesFigures::band_width), median(KnownBy::type, &SeriesFigures::band_width));
  EXPECT_LT(median(KnownBy::minute, &SeriesFigures::p95), median(KnownBy::type, &SeriesFigures::p95));
}

}  // namespace
}  // namespace spoolflow::analysis
