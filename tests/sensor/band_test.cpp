/// The band over many valves whose calibration is wrong by just what it says: 95 % is a promise.
#include "spoolflow/sensor/band.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "spoolflow/sensor/observer.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

/// How often the band holds the flow, over valves whose forces were calibrated with an error of `error_N`, one standard
/// deviation, between `from_s` and the end.
Judgement many_valves(const Course& course, double error_N, double from_s) {
  std::mt19937 generator(23);
  std::normal_distribution<double> normal;
  const auto run = ClosedFormRun(closed_form, course).sampled(course.end_s(), 2e-3);
  Judgement out;
  for (int k = 0; k < 200; ++k) {
    ObserverParameters<double> parameters = closed_form_observer<double>(closed_form);
    parameters.band.force_residual_N = error_N;
    parameters.band.force_share = parameters.band.rest_share = 1;  // all that the forces are said to be wrong by
    const double offset_N = error_N * normal(generator);
    for (double& force_N : parameters.spring.curve.values) force_N += offset_N;
    ObserverState<double> state{};
    double time_s = 0;
    for (const ValveSample& now : run) {
      time_s += 2e-3;
      const Estimate<double>& answer = step(parameters, state, now.measured);
      if (time_s > from_s) out.add(answer, now.flow_m3_per_s, closed_form.full_scale_m3_per_s());
    }
  }
  return out;
}

TEST(Band, HoldsWhatItPromisesWhereForcesAreWrongByWhatTheyAreSaidToBe) {
  Course sliding({.position_m = 0.4e-3});
  sliding.rest(0.1, 1).slide(2.0e-3, 1).rest(0.2, -1).slide(0.8e-3, 0.8).rest(0.2, 1).slide(2.0e-3, 0.8);
  Course resting({.position_m = 0.4e-3});
  resting.rest(0.1, 1).slide(1.6e-3, 1).rest(1.5, 0.5);
  for (const double error_N : {0.5, 1.5}) {
    const Judgement slides = many_valves(sliding, error_N, 0.6);
    EXPECT_GT(slides.coverage(), 0.93) << error_N;
    EXPECT_LT(slides.mean_width(), 8 * slides.rms()) << error_N;
    const Judgement rests = many_valves(resting, error_N, 1.2);
    EXPECT_GT(rests.coverage(), 0.9) << error_N;                      // a drag that noise faked costs some
    EXPECT_LT(rests.mean_width(), 0.2 + 5 * rests.rms()) << error_N;  // and what pre-sliding leaves open
  }
}

TEST(Band, IsAsWideAsTheForcesAreWrong) {
  Course sliding({.position_m = 0.4e-3});
  sliding.rest(0.1, 1).slide(2.0e-3, 1.5);
  const double narrow = many_valves(sliding, 0.5, 0.8).mean_width();
  const double wide = many_valves(sliding, 2.0, 0.8).mean_width();
  EXPECT_GT(wide, 1.8 * narrow);
  EXPECT_LT(wide, 4 * narrow);
}

/// At rest in the middle of a supply of which nothing is known; friction lies within 1 N to one side and 3 N to the
/// other of where it would have to be.
struct RestingSpool {
  RestingSpool() {
    pressure.pressure_difference_Pa = 40e5;
    pressure.process_noise = 1;
    pressure.unobserved_variance_Pa2 = squared(600e5);
    pressure.band_factor = 1;
    pressure.friction_ratio = calibrated_ratio;
    balance.edge = parameters.edge.at(313.0, 50e5, 1.2e-3);
    balance.residual_force_N = 0.5;
    balance.resting = {-2.5, 1.5, 0, 0};
  }
  [[nodiscard]] PressureBand<double> band() const {
    const PressureHalfWidths<double> reach =
        pressure_half_widths(parameters.band, pressure, balance, 3.0, 0.0,
                             displaced_ratio(parameters.pressure, pressure, calibrated_ratio), environment_N);
    return pressure_band(pressure, reach, 1000e5);
  }

  static constexpr double calibrated_ratio = 0.9;
  ObserverParameters<double> parameters = closed_form_observer<double>(closed_form);
  PressureState<double> pressure{};
  ForceBalance<double> balance{};
  double environment_N = 0;
};

TEST(Band, AtRestReachesFurtherToTheSideOfTheLongerPartOfFrictionsInterval) {
  RestingSpool spool;
  const double slope = ClosedFormValve::flow_force_per_pressure(1.2e-3);
  const double uncertain_N = 2 * bounds_deviation_N(spool.parameters.band, 3.0);
  EXPECT_NEAR(40e5 - spool.band().least_Pa, (interval_share * 1 / 4 + uncertain_N) / slope, 0.01e5);
  EXPECT_NEAR(spool.band().most_Pa - 40e5, (interval_share * 9 / 4 + uncertain_N) / slope, 0.01e5);
  spool.balance.sliding = true;
  EXPECT_EQ(spool.band().least_Pa, 0);
  EXPECT_DOUBLE_EQ(spool.band().most_Pa, (1 + ripple_share) * 1000e5);
}

TEST(Band, AtRestOnAKnownFrictionIsAsWideAsTheUncertaintyOfItsBounds) {
  RestingSpool spool;
  spool.balance.resting = {0.5, 0.5, 0, 0};
  const double uncertain_Pa =
      2 * bounds_deviation_N(spool.parameters.band, 3.0) / ClosedFormValve::flow_force_per_pressure(1.2e-3);
  EXPECT_NEAR(40e5 - spool.band().least_Pa, uncertain_Pa, 0.01e5);
  EXPECT_NEAR(spool.band().most_Pa - 40e5, uncertain_Pa, 0.01e5);
}

TEST(Band, AtTheHighestCalibratedPressureDifferenceHoldsTheRippleOfTheSupply) {
  RestingSpool spool;
  spool.pressure.pressure_difference_Pa = 999e5;
  EXPECT_GT(spool.band().most_Pa, 1000e5 * 1.01);
  EXPECT_LE(spool.band().expected_Pa, 1000e5);
}

TEST(Band, AtRestIsNarrowerThanWhatIsOpenAndWhatFrictionAllowsAlone) {
  RestingSpool spool;
  const double friction_Pa = 40e5 - spool.band().least_Pa;
  const double slope = ClosedFormValve::flow_force_per_pressure(1.2e-3);
  spool.parameters.band.unobserved_factor = 0.5;
  spool.pressure.unobserved_variance_Pa2 = squared(friction_Pa);  // two deviations of half of it
  EXPECT_NEAR(40e5 - spool.band().least_Pa, friction_Pa / std::sqrt(2), 0.02 * friction_Pa);
  spool.pressure.unobserved_variance_Pa2 = 0;
  const double noise_Pa = 40e5 - spool.band().least_Pa;
  EXPECT_LT(noise_Pa, 0.1 / slope);
}

TEST(Band, ExpectsThePressureDifferenceTowardsWhereMoreIsOpen) {
  RestingSpool spool;
  const PressureBand<double> band = spool.band();
  EXPECT_GT(band.expected_Pa, 40e5);
  EXPECT_LT(band.expected_Pa, (band.least_Pa + band.most_Pa) / 2);
  spool.balance.resting = {-0.5, 1.5, 0, 0};  // friction as far from either bound
  EXPECT_DOUBLE_EQ(spool.band().expected_Pa, 40e5);
  spool.pressure.unobserved_variance_Pa2 = 0;  // and of a supply that was just seen
  spool.balance.resting = {-2.5, 1.5, 0, 0};
  EXPECT_NEAR(spool.band().expected_Pa, 40e5, 0.02e5);
}

TEST(Band, InMotionDoubtsFrictionThatIsNotAsCalibrated) {
  RestingSpool spool;
  spool.balance.sliding = true;
  spool.balance.friction_N = spool.balance.residual_force_N = 4;
  spool.pressure.unobserved_variance_Pa2 = 0;
  const auto half_N = [&] { return (40e5 - spool.band().least_Pa) * ClosedFormValve::flow_force_per_pressure(1.2e-3); };
  const double as_calibrated_N = half_N();
  const double expected = spool.parameters.pressure.ratio_deviation;
  for (const double sign : {-1, 1}) {
    spool.pressure.friction_ratio = RestingSpool::calibrated_ratio + sign * expected;
    EXPECT_NEAR(half_N(), as_calibrated_N, 1e-9);
    spool.pressure.friction_ratio = RestingSpool::calibrated_ratio + sign * (expected + 0.2);
    EXPECT_NEAR(half_N(), std::hypot(as_calibrated_N, displaced_friction_factor * 0.2 * 4), 0.01);
  }
}

TEST(Band, HoldsWhatTheMachineLeavesOpenInMotionAndBeyondFrictionsBoundsAtRest) {
  RestingSpool spool;
  const double slope = ClosedFormValve::flow_force_per_pressure(1.2e-3);
  spool.environment_N = 2;
  const double uncertain_N = 2 * bounds_deviation_N(spool.parameters.band, 3.0);
  EXPECT_NEAR((40e5 - spool.band().least_Pa) * slope, interval_share * 1 / 4 + std::hypot(uncertain_N, 4), 0.1);
  spool.balance.sliding = true;
  spool.pressure.unobserved_variance_Pa2 = 0;
  spool.balance.friction_N = spool.balance.residual_force_N;
  EXPECT_NEAR((40e5 - spool.band().least_Pa) * slope, 4, 0.3);
}

TEST(Band, AtRestHoldsThatFrictionMayHaveHeldWhatThePressureYielded) {
  RestingSpool spool;
  const double before_Pa = 40e5 - spool.band().least_Pa;
  spool.pressure.constrained_correction_Pa =
      15e5;  // it went up by so much because friction was not thought able to hold it
  EXPECT_GT(40e5 - spool.band().least_Pa, std::hypot(before_Pa, 14e5));
  EXPECT_LT(spool.band().least_Pa, 25e5);
}

TEST(Band, OfTheFlowCountsItsOwnResidualAsIndependentOfThePressure) {
  ObserverParameters<double> parameters{};
  parameters.band.flow_residual_m3_per_s = 1e-6;
  Estimate<double> answer{.flow_m3_per_s = 5e-4};
  band_of_flow(parameters, 5e-4, 5e-4, answer);
  EXPECT_NEAR(answer.flow_upper_m3_per_s - 5e-4, flow_residual_factor * 1e-6, 1e-12);
  EXPECT_NEAR(5e-4 - answer.flow_lower_m3_per_s, flow_residual_factor * 1e-6, 1e-12);
  band_of_flow(parameters, 5e-4 - 4e-6, 5e-4 + 3e-6, answer);
  EXPECT_NEAR(answer.flow_upper_m3_per_s - 5e-4, std::hypot(flow_residual_factor, 3) * 1e-6, 1e-12);
  EXPECT_NEAR(5e-4 - answer.flow_lower_m3_per_s, std::hypot(flow_residual_factor, 4) * 1e-6, 1e-12);
}

}  // namespace
}  // namespace spoolflow::sensor
