/// The oil of references beside the sensor's, in closed form.
#include "spoolflow/calibration/references/oil_ratios.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/calibration/references/wear_search.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double volume_m3 = 2.6e-3, full_flow_m3_per_s = 80.0 / 60000;

/// Strokes of 3 to 12.5 s; what passed the valve by the sensor is `share` of what filled the cylinder, and a leakage.
std::vector<OilRatio> strokes(double share, double leak_m3_per_s) {
  std::vector<PassedOil> oil;
  std::vector<double> sensor_m3;
  for (int k = 0; k < 20; ++k) {
    const double seconds = 3 + 0.5 * k, scatter = 1 + 0.01 * (k % 3 - 1);
    oil.push_back({0, 20.0 * k, 20.0 * k + seconds, volume_m3, 0.002 * volume_m3});
    sensor_m3.push_back(share * scatter * (volume_m3 + leak_m3_per_s * seconds));
  }
  return oil_ratios(oil, sensor_m3, full_flow_m3_per_s);
}

TEST(OilRatios, AllStrokesTogetherKnowTheShareBetterThanOneOfThem) {
  const OilLevel level = level_of(strokes(0.95, 0), 0);
  EXPECT_NEAR(level.log_ratio, -std::log(0.95), 0.002);
  EXPECT_LT(level.deviation, 0.5 * sensor::ReferencePriors::volume_chance_share);
  EXPECT_EQ(level.count, 20U);
}

TEST(OilRatios, OneStrokeThatLostThePressureMovesTheLevelByLessThanItsOwnShare) {
  std::vector<OilRatio> ratios = strokes(1, 0);
  ratios[4].log_ratio += 0.2;
  EXPECT_LT(std::abs(level_of(ratios, 0).log_ratio), 0.002);
  leave_out_apart(ratios);
  EXPECT_FALSE(ratios[4].used);
  EXPECT_EQ(level_of(ratios, 0).count, 19U);
}

TEST(OilRatios, ALeakingSealTakesMoreOfSlowStrokes) {
  constexpr double leak_m3_per_s = 1.0 / 60000;
  const OilLeak leak = leak_of(strokes(0.97, leak_m3_per_s), 0);
  EXPECT_NEAR(leak.leak_m3_per_s, leak_m3_per_s, 0.2 * leak_m3_per_s);
  EXPECT_GT(leak.gain, contradiction_evidence);
  EXPECT_LT(leak_of(strokes(0.97, 0), 0).gain, contradiction_evidence);
}

TEST(OilRatios, AReturnStrokeThatTheValvesOtherSideFedIsNotCounted) {
  const std::vector<OilRatio> ratios = oil_ratios({{0, 0, 4, volume_m3, 0}, {0, 5, 9, volume_m3, 0}},
                                                  {volume_m3, 0.001 * volume_m3}, full_flow_m3_per_s);
  EXPECT_TRUE(ratios[0].used);
  EXPECT_FALSE(ratios[1].used);
}

TEST(OilRatios, AVolumeStatedInAnotherUnitIsNoneOfTheSensorsOil) {
  for (const OilRatio& each : strokes(100, 0)) EXPECT_FALSE(each.used);
}

TEST(EvidenceOfChange, WantsMoreThanTheDeviationAndPaysForTheWidthItAllows) {
  EXPECT_LT(evidence_of_change(0, 1, 3), 0);
  EXPECT_LT(evidence_of_change(1.5, 1, 3), change_evidence);
  EXPECT_GT(evidence_of_change(3, 1, 3), change_evidence);
  EXPECT_GT(evidence_of_change(0, 1, 3), evidence_of_change(0, 1, 30));
}

constexpr double width_slope = 0.5, known_share = 0.012;

TEST(WearOrMisstated, ALittleMoreOilIsWearAndMuchMoreIsAMisstatedArea) {
  const EdgeChange little = wear_or_misstated({0.035, known_share, 1}, width_slope),
                   much = wear_or_misstated({0.14, known_share, 1}, width_slope);
  EXPECT_LT(little.misstated, -contradiction_evidence);
  EXPECT_GT(much.misstated, contradiction_evidence);
  EXPECT_NEAR(much.asked, 0.14 / width_slope, 1e-12);
}

TEST(WearOrMisstated, BetweenThemTheDeviationHoldsTheWidthOfEither) {
  for (const double log_ratio : {0.05, 0.07, 0.09}) {
    const EdgeChange change = wear_or_misstated({log_ratio, known_share, 1}, width_slope);
    EXPECT_NEAR(change.value, 0.86 * log_ratio / width_slope, 0.02 * log_ratio / width_slope);
    EXPECT_GT(2 * change.deviation, 0.7 * change.value) << log_ratio;
  }
}

}  // namespace
}  // namespace spoolflow::calibration
