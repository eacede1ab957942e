#include "spoolflow/validation/metrics.hpp"

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

TEST(ErrorFigures, OfAHundredErrorsThe95thPercentileIsTheOneThat95DoNotReach) {
  std::vector<float> errors;
  for (int k = 0; k < 100; ++k) errors.push_back(static_cast<float>(k % 2 == 0 ? k : -k));  // magnitudes 0 to 99
  const ErrorFigures figures = error_figures(errors);
  EXPECT_EQ(figures.samples, 100U);
  EXPECT_DOUBLE_EQ(figures.p95, 95);
  EXPECT_DOUBLE_EQ(figures.largest, 99);
  EXPECT_DOUBLE_EQ(figures.bias, -0.5);
  EXPECT_NEAR(figures.rms, 57.302, 1e-3);
}

TEST(ErrorFigures, OfOneErrorAreThatError) {
  const ErrorFigures figures = error_figures({-3.0F});
  EXPECT_DOUBLE_EQ(figures.p95, 3);
  EXPECT_DOUBLE_EQ(figures.rms, 3);
  EXPECT_DOUBLE_EQ(figures.largest, 3);
  EXPECT_DOUBLE_EQ(figures.bias, -3);
}

TEST(ErrorFigures, OfNothingAreZeroWithZeroSamples) {
  const ErrorFigures figures = error_figures({});
  EXPECT_EQ(figures.samples, 0U);
  EXPECT_DOUBLE_EQ(figures.p95, 0);
}

constexpr double unit_scale = 1.0;

/// Estimates 0.1 too much with a band of +-0.15, so that the reference is inside.
ComparedSample moving_sample(double reference) {
  return {reference + 0.1, reference - 0.05, reference + 0.25, reference, true, false, false};
}
/// Estimates 0.3 too little with a band of +-0.1, so that the reference is outside.
ComparedSample resting_sample(double reference) {
  return {reference - 0.3, reference - 0.4, reference - 0.2, reference, false, true, true};
}

TEST(ComparedSamples, AreSeparatedByWhatTheSpoolDid) {
  ComparedSamples samples(unit_scale);
  for (int k = 0; k < 30; ++k) samples.add(moving_sample(0.5));
  for (int k = 0; k < 10; ++k) samples.add(resting_sample(0.5));
  const Metrics metrics = samples.metrics();
  EXPECT_EQ(metrics.all.error.samples, 40U);
  EXPECT_NEAR(metrics.moving.error.p95, 0.1, 1e-6);
  EXPECT_NEAR(metrics.rest.error.bias, -0.3, 1e-6);
  EXPECT_EQ(metrics.reversal.error.samples, 10U);
  EXPECT_DOUBLE_EQ(metrics.all.band_coverage, 0.75);
  EXPECT_DOUBLE_EQ(metrics.moving.band_coverage, 1.0);
  EXPECT_DOUBLE_EQ(metrics.rest.band_coverage, 0.0);
  EXPECT_NEAR(metrics.moving.band_mean_width_m3_per_s, 0.3, 1e-6);
  EXPECT_NEAR(metrics.rest.band_mean_width_m3_per_s, 0.2, 1e-6);
}

TEST(ComparedSamples, StateErrorsOfReadingOnlyWhereThereIsAReading) {
  ComparedSamples samples(unit_scale);
  samples.add(moving_sample(0.05));  // below a tenth of full scale
  samples.add(moving_sample(0.5));
  const Metrics metrics = samples.metrics();
  EXPECT_EQ(metrics.share_of_reading.samples, 1U);
  EXPECT_NEAR(metrics.share_of_reading.p95, 0.2, 1e-6);
}

TEST(ComparedSamples, OfARunThatNeverMovedHaveNoFiguresOfMotion) {
  ComparedSamples samples(unit_scale);
  samples.add(resting_sample(0.5));
  const Metrics metrics = samples.metrics();
  EXPECT_EQ(metrics.moving.error.samples, 0U);
  EXPECT_EQ(metrics.rest.error.samples, 1U);
}

TEST(ComparedSamples, OfTwoRunsTogetherAreTheSamplesOfBoth) {
  ComparedSamples first(unit_scale);
  first.add(moving_sample(0.5));
  ComparedSamples second(unit_scale);
  second.add(resting_sample(0.5));
  second.add(resting_sample(0.7));
  first.append(second);
  EXPECT_EQ(first.metrics().all.error.samples, 3U);
  EXPECT_EQ(first.metrics().rest.error.samples, 2U);
  EXPECT_NEAR(first.metrics().all.error.bias, (0.1 - 0.3 - 0.3) / 3, 1e-6);
}

}  // namespace
}  // namespace spoolflow::validation
