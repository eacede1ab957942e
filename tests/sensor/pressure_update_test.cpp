/// One update of the hidden pressure difference by each kind of evidence, against Bayes' rule worked out by hand.
#include "spoolflow/sensor/pressure_update.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::sensor {
namespace {

constexpr double force_slope_N_per_Pa = 5e-6;
constexpr double spool_slides_N = 6;
constexpr double forces_noise_N = 0.7;
constexpr double sampled_s = 1e-3;
constexpr double prior_Pa = 60e5, prior_deviation_Pa = 2e5;

ObserverParameters<double> updated_valve() {
  ObserverParameters<double> out{};
  out.edge.pressure_difference_Pa = {0, 10e5, 1 / 10e5};  // up to 80 bar
  out.pressure = {.sliding_drift_Pa_per_sqrt_s = 2e5,
                  .resting_drift_Pa_per_sqrt_s = 1e6,
                  .least_process_noise = 0.0009,
                  .first_process_noise = 0.1,
                  .constrained_correction_s = 0.03,
                  .force_correlation_s = 2e-3,
                  .ratio_deviation = 0.05,
                  .ratio_memory_s = 10};
  out.friction.ageing_ratio = 1.5;
  out.friction.ageing_s = 2.5;
  out.friction.breakaway_share = 0.12;
  out.friction.tolerance_N = 0.7;
  out.band.unobserved_factor = 2;
  return out;
}

PressureState<double> prior() {
  PressureState<double> out{};
  begin(updated_valve().pressure, out, 80e5, 1.0, 2.0);
  out.pressure_difference_Pa = prior_Pa;
  out.variance_Pa2 = squared(prior_deviation_Pa);
  return out;
}

/// An open spool whose forces ask for `innovation_N` more flow force.
ForceBalance<double> balance_of(bool sliding, double innovation_N) {
  ForceBalance<double> out{};
  out.edge.flow_force_per_pressure_N_Pa = force_slope_N_per_Pa;
  out.edge.friction_N = out.spool_friction_N = spool_slides_N;
  out.friction_N = spool_slides_N;
  out.residual_force_N = spool_slides_N + innovation_N;
  out.noise_N = forces_noise_N;
  out.direction = 1;
  out.settled = true;
  out.sliding = sliding;
  return out;
}

constexpr auto nothing = [] {};  // is asked of a closed valve
constexpr PressureTiming<double> timing{{false, 0.0}, false, sampled_s};

TEST(PressureUpdate, OfASlidingSpoolAtAKnownFrictionRatioIsTheScalarKalmanFilter) {
  PressureState<double> state = prior();
  state.ratio_variance = 0;
  double mean_Pa = prior_Pa, variance_Pa2 = squared(prior_deviation_Pa);
  for (const double innovation_N : {0.5, -0.3, 0.4}) {
    EXPECT_EQ(update(updated_valve(), state, balance_of(true, innovation_N), timing, nothing), 0);
    // Two samples share one piece of evidence. The posterior weighs prior and measurement by one over their variances.
    variance_Pa2 += squared(2e5) * sampled_s;
    const double measured_variance_Pa2 = 2 * squared(forces_noise_N / force_slope_N_per_Pa);
    const double posterior_Pa2 = 1 / (1 / variance_Pa2 + 1 / measured_variance_Pa2);
    const double measured_Pa = mean_Pa + innovation_N / force_slope_N_per_Pa;
    mean_Pa = posterior_Pa2 * (mean_Pa / variance_Pa2 + measured_Pa / measured_variance_Pa2);
    variance_Pa2 = posterior_Pa2;
    EXPECT_NEAR(state.pressure_difference_Pa, mean_Pa, 1e-6);
    EXPECT_NEAR(state.variance_Pa2, variance_Pa2, 1e-9 * variance_Pa2);
  }
}

TEST(PressureUpdate, OfASlidingSpoolDividesAnInnovationBetweenPressureAndFrictionAsTheirVariancesAre) {
  PressureState<double> state = prior();
  constexpr double innovation_N = 0.5;
  update(updated_valve(), state, balance_of(true, innovation_N), timing, nothing);
  const double of_pressure_N2 =
      squared(force_slope_N_per_Pa) * (squared(prior_deviation_Pa) + squared(2e5) * sampled_s);
  const double of_ratio_N2 = squared(spool_slides_N * 0.05);
  const double all_N2 = of_pressure_N2 + of_ratio_N2 + 2 * squared(forces_noise_N);
  EXPECT_NEAR(force_slope_N_per_Pa * (state.pressure_difference_Pa - prior_Pa), innovation_N * of_pressure_N2 / all_N2,
              1e-9);
  EXPECT_NEAR(spool_slides_N * (state.friction_ratio - 1), innovation_N * of_ratio_N2 / all_N2, 1e-9);
  EXPECT_NEAR(squared(force_slope_N_per_Pa) * state.variance_Pa2, of_pressure_N2 * (1 - of_pressure_N2 / all_N2), 1e-9);
  EXPECT_NEAR(squared(spool_slides_N) * state.ratio_variance, of_ratio_N2 * (1 - of_ratio_N2 / all_N2), 1e-9);
  EXPECT_NEAR(force_slope_N_per_Pa * spool_slides_N * state.covariance_Pa, -of_pressure_N2 * of_ratio_N2 / all_N2,
              1e-9);
}

TEST(PressureUpdate, OfABreakawayIsOneMeasurementAsSureAsBreakawayForcesRepeat) {
  PressureState<double> state = prior();
  state.ratio_variance = 0;
  constexpr double rested_s = 2.5, excess_N = 0.6;
  constexpr double limit_N = 1.25 * spool_slides_N;  // half of the ageing after its time constant
  ForceBalance<double> breaks = balance_of(false, 0);
  breaks.resting.breakaway_N = limit_N + excess_N;
  breaks.resting.rested_s = rested_s;
  breaks.slips = true;
  update(updated_valve(), state, breaks, timing, nothing);
  const double prior_N2 =
      squared(force_slope_N_per_Pa) *
      (squared(prior_deviation_Pa) + updated_valve().pressure.first_process_noise * 1e12 * sampled_s);
  const double gain = prior_N2 / (prior_N2 + squared(forces_noise_N) + squared(0.12 * limit_N));
  EXPECT_NEAR(force_slope_N_per_Pa * (state.pressure_difference_Pa - prior_Pa), gain * excess_N, 1e-9);
  EXPECT_NEAR(squared(force_slope_N_per_Pa) * state.variance_Pa2, prior_N2 * (1 - gain), 1e-9);
  EXPECT_EQ(state.friction_ratio, 1);
}

TEST(PressureUpdate, AtRestDividesWhatFrictionCannotHoldBetweenPressureAndFriction) {
  for (const double beyond_N : {2.0, -2.0}) {
    PressureState<double> state = prior();
    const double to_friction_N = update(updated_valve(), state, balance_of(false, beyond_N), timing, nothing);
    const double prior_N2 =
        squared(force_slope_N_per_Pa) *
        (squared(prior_deviation_Pa) + updated_valve().pressure.first_process_noise * 1e12 * sampled_s);
    const double share = prior_N2 / (prior_N2 + squared(updated_valve().friction.tolerance_N));
    const double now_N = beyond_N * sampled_s / updated_valve().pressure.constrained_correction_s;
    EXPECT_NEAR(force_slope_N_per_Pa * (state.pressure_difference_Pa - prior_Pa), share * now_N, 1e-9);
    EXPECT_NEAR(to_friction_N, (1 - share) * now_N, 1e-9);
    EXPECT_EQ(state.variance_Pa2, squared(prior_deviation_Pa) + 0.1 * (squared(1e6) * sampled_s));  // it says no more
  }
}

TEST(PressureUpdate, WithinFrictionsBoundsOrBehindAClosedEdgeMovesNothingAndGrowsUncertain) {
  for (const bool closed : {false, true}) {
    PressureState<double> state = prior();
    state.process_noise = 0.001;  // of a steady supply
    ForceBalance<double> rests = balance_of(false, closed ? 3 : 0);
    rests.closed = closed;
    EXPECT_EQ(update(updated_valve(), state, rests, timing, nothing), 0);
    EXPECT_EQ(state.pressure_difference_Pa, prior_Pa);
    const double process_noise = closed ? updated_valve().pressure.first_process_noise : 0.001;
    EXPECT_DOUBLE_EQ(state.process_noise, process_noise);
    EXPECT_DOUBLE_EQ(state.variance_Pa2, squared(prior_deviation_Pa) + process_noise * squared(1e6) * sampled_s);
  }
}

TEST(PressureUpdate, BeginsAgainWhereForcesLeaveNoVariance) {
  PressureState<double> state = prior();
  state.variance_Pa2 = NAN;
  update(updated_valve(), state, balance_of(false, 0), timing, nothing);
  EXPECT_DOUBLE_EQ(state.pressure_difference_Pa, first_pressure_share * 80e5);
  EXPECT_DOUBLE_EQ(state.variance_Pa2, squared(first_deviation_share * 80e5));
}

}  // namespace
}  // namespace spoolflow::sensor
