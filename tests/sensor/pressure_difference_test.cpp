/// The hidden states, fed with forces whose origin is known.
#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/sensor/band.hpp"
#include "spoolflow/sensor/pressure_update.hpp"

namespace spoolflow::sensor {
namespace {

constexpr PressureParameters<double> supply{.sliding_drift_Pa_per_sqrt_s = 2e5,
                                            .resting_drift_Pa_per_sqrt_s = 1e6,
                                            .least_process_noise = 0.0009,
                                            .first_process_noise = 0.1,
                                            .constrained_correction_s = 0.03,
                                            .force_correlation_s = 2e-3,
                                            .ratio_deviation = 0.05,
                                            .ratio_memory_s = 10};
constexpr double slope_N_per_Pa = 5e-6;
constexpr double friction_N = 6;
constexpr double highest_Pa = 70e5;

PressureState<double> begin(double pressure_Pa) {
  PressureState<double> state{};
  state.pressure_difference_Pa = pressure_Pa;
  state.variance_Pa2 = std::pow(10e5, 2);
  state.friction_ratio = 1;
  state.ratio_variance = std::pow(supply.ratio_deviation, 2);
  state.process_noise = supply.first_process_noise;
  state.innovation_squared = usual_innovation_squared;
  follow_agreement(state);
  return state;
}

/// Slides for `duration_s` at a true pressure difference and friction ratio.
void slide(PressureState<double>& state, double true_Pa, double true_ratio, double direction, double duration_s,
           double dt_s) {
  for (int k = 0; k * dt_s < duration_s; ++k) {
    drift(supply, state, dt_s, highest_Pa);
    forget_ratio(supply, state, 1.0, dt_s);
    const double innovation_N = slope_N_per_Pa * (true_Pa - state.pressure_difference_Pa) +
                                direction * friction_N * (true_ratio - state.friction_ratio);
    update_sliding(supply, state, {innovation_N, slope_N_per_Pa, direction * friction_N, 0.7}, dt_s, highest_Pa);
  }
}

TEST(PressureDifference, IsFoundWhileTheSpoolSlides) {
  PressureState<double> state = begin(35e5);
  slide(state, 60e5, 1, 1, 1, 1e-3);
  EXPECT_NEAR(state.pressure_difference_Pa, 60e5, 1e5);
  EXPECT_LT(std::sqrt(state.variance_Pa2), 1.5e5);
}

TEST(PressureDifference, IsFoundAsFastAtAnySamplingRate) {
  for (const double dt_s : {5e-5, 1e-4, 1e-3, 5e-3}) {
    PressureState<double> state = begin(35e5);
    slide(state, 60e5, 1, 1, 0.05, dt_s);
    PressureState<double> reference = begin(35e5);
    slide(reference, 60e5, 1, 1, 0.05, 1e-3);
    EXPECT_NEAR(state.pressure_difference_Pa, reference.pressure_difference_Pa, 1e5) << dt_s;
    // At 5 ms each sample stands for itself: fewer pieces of evidence in the same time.
    EXPECT_NEAR(std::sqrt(state.variance_Pa2 / reference.variance_Pa2), 1, dt_s > 2e-3 ? 0.15 : 0.1) << dt_s;
  }
}

TEST(PressureDifference, TakesOneSampleForNoMoreThanOneHoweverLongItsStep) {
  for (const double dt_s : {2e-3, 5e-3, 20e-3}) {
    PressureState<double> state = begin(35e5);
    state.ratio_variance = 0;
    update_sliding(supply, state, {slope_N_per_Pa * 5e5, slope_N_per_Pa, friction_N, 0.7}, dt_s, highest_Pa);
    const double measured_Pa = 0.7 / slope_N_per_Pa;  // what one force balance shows
    EXPECT_NEAR(std::sqrt(state.variance_Pa2), measured_Pa * 10e5 / std::hypot(measured_Pa, 10e5), 1e3) << dt_s;
  }
}

/// Ten seconds in which what the forces leave unexplained swings by `amplitude_N` at 20 Hz, as under dither.
PressureState<double> swung(double amplitude_N) {
  PressureState<double> state = begin(60e5);
  for (int k = 0; k < 10000; ++k) {
    drift(supply, state, 1e-3, highest_Pa);
    const double innovation_N =
        slope_N_per_Pa * (60e5 - state.pressure_difference_Pa) + amplitude_N * std::sin(0.126 * k);
    update_sliding(supply, state, {innovation_N, slope_N_per_Pa, friction_N, 0.7}, 1e-3, highest_Pa);
  }
  follow_agreement(state);
  return state;
}

TEST(Band, NarrowsWhereEverySampleConfirmsTheOneBefore) {
  EXPECT_DOUBLE_EQ(begin(60e5).band_factor, 1);
  EXPECT_LT(swung(0.05).band_factor, 0.75);
}

TEST(Band, WidensWhereForcesSwingBeyondTheirNoise) {
  EXPECT_GT(swung(3).band_factor, 1.5);
  EXPECT_LE(swung(1000).band_factor, 2.5);
}

TEST(PressureDifference, IsNotBlamedForFrictionThatChangedOnceTheSpoolHasTurnedOftenEnough) {
  PressureState<double> state = begin(60e5);
  for (int stroke = 0; stroke < 60; ++stroke) slide(state, 60e5, 1.3, stroke % 2 == 0 ? 1 : -1, 0.5, 1e-3);
  EXPECT_NEAR(state.friction_ratio, 1.3, 0.05);
  EXPECT_NEAR(state.pressure_difference_Pa, 60e5, 1e5);
}

TEST(PressureDifference, TakesAStepOfTheSupplyForWhatItIs) {
  PressureState<double> state = begin(60e5);
  slide(state, 60e5, 1, 1, 2, 1e-3);
  slide(state, 30e5, 1, 1, 0.5, 1e-3);
  EXPECT_NEAR(state.pressure_difference_Pa, 30e5, 2e5);
  EXPECT_NEAR(state.friction_ratio, 1, 0.1);
}

TEST(PressureDifference, StaysWhereNoPressureDifferenceCouldExplainTheForce) {
  // Hardly open, 1 bar makes 2 mN: two newtons that are missing are friction's, not a supply that broke down.
  PressureState<double> state = begin(50e5);
  state.variance_Pa2 = std::pow(2e5, 2);
  for (int k = 0; k < 3; ++k) {
    drift(supply, state, 1e-3, highest_Pa);
    update_sliding(supply, state, {-2.0, 2e-8, friction_N, 0.7}, 1e-3, highest_Pa);
  }
  EXPECT_GT(state.pressure_difference_Pa, 25e5);
  EXPECT_LE(std::sqrt(state.variance_Pa2), 1.01 * most_deviation_share * highest_Pa);
}

TEST(PressureDifference, ShowsLittleOfTheSupplyWhenFirstSeen) {
  PressureState<double> state{};
  begin(supply, state, highest_Pa, 1.0, 2.0);
  for (int k = 0; k < 500; ++k) drift_unobserved(supply, state, 1e-3, highest_Pa);
  state.pressure_difference_Pa = 60e5;
  learn_process_noise(supply, state, 1e5);
  EXPECT_EQ(state.process_noise, first_observed_process_noise);
  for (int k = 0; k < 500; ++k) drift_unobserved(supply, state, 1e-3, highest_Pa);
  state.pressure_difference_Pa = 45e5;
  learn_process_noise(supply, state, 1e5);
  EXPECT_GT(state.process_noise, 0.5);
}

TEST(PressureDifference, LearnsFromABreakawayButTheFrictionRatioDoesNot) {
  PressureState<double> state = begin(60e5);
  slide(state, 60e5, 1, 1, 1, 1e-3);
  const PressureState<double> before = state;
  update_breakaway(supply, state, {2.0, slope_N_per_Pa, friction_N, 0.7}, 0.0, highest_Pa);
  EXPECT_GT(state.pressure_difference_Pa, before.pressure_difference_Pa);
  EXPECT_LT(state.variance_Pa2, before.variance_Pa2);
  EXPECT_EQ(state.friction_ratio, before.friction_ratio);
  EXPECT_EQ(state.ratio_variance, before.ratio_variance);
}

TEST(PressureDifference, NoNumberOfBreakawaysAveragesAwayWhatAllAreOffByAndSlidingTakesItAway) {
  PressureState<double> state = begin(60e5);
  constexpr double common_N = 1.5;
  for (int k = 0; k < 40; ++k) {
    for (int rest = 0; rest < 100; ++rest) drift_unobserved(supply, state, 1e-3, highest_Pa);
    update_breakaway(supply, state, {0.0, slope_N_per_Pa, friction_N, common_N}, common_N, highest_Pa);
  }
  EXPECT_NEAR(state.breakaway_Pa * slope_N_per_Pa, common_N, 0.02 * common_N);
  update_breakaway(supply, state, {0.0, slope_N_per_Pa, friction_N, common_N}, -common_N, highest_Pa);
  EXPECT_LT(state.breakaway_Pa * slope_N_per_Pa, common_N) << "broken away the other way, it errs the other way";
  slide(state, 60e5, 1, 1, 1, 1e-3);
  EXPECT_LT(state.breakaway_Pa * slope_N_per_Pa, 0.1 * common_N);
}

TEST(PressureDifference, ForgetsAFrictionRatioThatSlidingNoLongerConfirms) {
  PressureState<double> state = begin(60e5);
  state.friction_ratio = 1.3;
  for (int k = 0; k < 30'000; ++k) forget_ratio(supply, state, 1.0, 1e-3);
  EXPECT_NEAR(state.friction_ratio, 1, 0.02);
  EXPECT_NEAR(state.ratio_variance, std::pow(supply.ratio_deviation, 2), 1e-6);
}

TEST(Band, ABreakawayTakesTheVarianceOfUnseenChangesAway) {
  PressureState<double> state = begin(60e5);
  for (int k = 0; k < 500; ++k) drift_unobserved(supply, state, 1e-3, highest_Pa);
  const double before_Pa = unobserved_change_Pa(state, 4.0);
  update_breakaway(supply, state, {0.0, slope_N_per_Pa, friction_N, 0.7}, 0.0, highest_Pa);
  EXPECT_LT(unobserved_change_Pa(state, 4.0), 0.5 * before_Pa);
}

TEST(Band, KnowsThatWhatIsMeasuredIsSomeMillisecondsOld) {
  PressureState<double> state = begin(60e5);
  slide(state, 60e5, 1, 1, 1, 1e-3);
  state.process_noise = 0.5;
  const double of_a_walk_Pa = 0.5 * supply.resting_drift_Pa_per_sqrt_s * std::sqrt(measurement_delay_s);
  EXPECT_NEAR(unobserved_change_Pa(state, 1.0), of_a_walk_Pa, 1e-3 * of_a_walk_Pa);
}

TEST(Band, TakesUnseenChangesForLargeWhereTheSupplyHasProvedLively) {
  PressureState<double> state = begin(60e5);
  for (int k = 0; k < 500; ++k) drift_unobserved(supply, state, 1e-3, highest_Pa);
  state.process_noise = 0.01;
  const double steady_Pa = unobserved_change_Pa(state, 4.0);
  state.process_noise = 0.5;
  EXPECT_NEAR(unobserved_change_Pa(state, 4.0), 50 * steady_Pa, 1e-6 * steady_Pa);
}

TEST(PressureDifference, IsNotTakenForLivelyByWhatTheForcesErrorsMakeOfIt) {
  PressureState<double> state = begin(60e5);
  const double noise_Pa = 1e5;
  state.observed_Pa = 60e5 - 0.4 * noise_Pa;
  state.drift_variance_Pa2 = 1.1 * noise_Pa * noise_Pa;
  learn_process_noise(supply, state, noise_Pa);
  EXPECT_LT(state.process_noise, supply.first_process_noise);
  state.observed_Pa = state.pressure_difference_Pa - 20 * noise_Pa;
  state.drift_variance_Pa2 = 400 * noise_Pa * noise_Pa;
  learn_process_noise(supply, state, noise_Pa);
  EXPECT_GT(state.process_noise, 0.5);
}

TEST(PressureDifference, MayDoWhatItLikesBehindAClosedValve) {
  PressureState<double> state = begin(60e5);
  state.process_noise = 1e-4;
  expect_change(supply, state);
  EXPECT_DOUBLE_EQ(state.process_noise, supply.first_process_noise);
}

TEST(PressureDifference, GrowsUncertainAtRestAsFastAsTheSupplyHasProvedLively) {
  PressureState<double> steady = begin(60e5);
  PressureState<double> lively = steady;
  steady.process_noise = 0.001;
  lively.process_noise = 1;
  for (int k = 0; k < 500; ++k) {
    drift_unobserved(supply, steady, 1e-3, highest_Pa);
    drift_unobserved(supply, lively, 1e-3, highest_Pa);
  }
  EXPECT_GT(lively.variance_Pa2 - begin(60e5).variance_Pa2, 100 * (steady.variance_Pa2 - begin(60e5).variance_Pa2));
  for (int k = 0; k < 100'000; ++k) drift_unobserved(supply, lively, 1e-3, highest_Pa);
  EXPECT_LT(std::sqrt(lively.variance_Pa2), 0.5 * highest_Pa);
}

}  // namespace
}  // namespace spoolflow::sensor
