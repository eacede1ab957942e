/// What only operation shows comes out of a recording whose friction is known.
#include "spoolflow/calibration/operation/operation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/calibration/operation/band.hpp"
#include "spoolflow/calibration/operation/operation_score.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

constexpr double full_scale_m3_per_s = 80 / 60e3;

/// The valve of the example, whose tables serve as the valve itself.
sensor::ObserverParameters<double> example_valve() {
  return model::read_model(SPOOLFLOW_EXAMPLE_MODEL).observer->parameters;
}

/// A triangle at 60 bar and 50 C: what the current would be if spring, flow force and `friction_ratio` times the
/// bench's friction were all there is. The actuator is inverted by bisection of its static map.
recording::Recording triangle(const sensor::ObserverParameters<double>& valve, double friction_ratio) {
  constexpr double dt_s = 2e-3;
  constexpr double half_s = 8;
  constexpr double pressure_Pa = 60e5;
  constexpr double temperature_K = 323.15;
  recording::Recording out;
  for (int k = 0; k * dt_s < 4 * half_s; ++k) {
    const double phase = std::fmod(k * dt_s, 2 * half_s);
    const bool opening = phase < half_s;
    const double position_m = 0.4e-3 + 1.5e-3 * (opening ? phase : 2 * half_s - phase) / half_s;
    const auto edge = valve.edge.at(temperature_K, pressure_Pa, position_m);
    const double sign = opening ? 1 : -1;
    double low_A = 0;
    double high_A = valve.largest_current_A;
    for (int halving = 0; halving < 40; ++halving) {
      const double current_A = 0.5 * (low_A + high_A);
      const double armature_N = friction_ratio * valve.actuator.friction_N.at(current_A, position_m).value;
      const double wanted_N = valve.spring.at(position_m).value + edge.flow_force_N +
                              sign * (friction_ratio * edge.friction_N + armature_N);
      (valve.actuator.magnetic_force.at(current_A, position_m).value < wanted_N ? low_A : high_A) = current_A;
    }
    out.column(Channel::time).push_back(k * dt_s);
    out.column(Channel::current).push_back(low_A);
    out.column(Channel::position).push_back(position_m);
    out.column(Channel::oil_temperature).push_back(temperature_K);
    out.column(Channel::flow_reference).push_back(edge.conductance * std::sqrt(pressure_Pa));
  }
  return out;
}

TEST(Operation, ScoreIsInfiniteWhereThereIsNothingToCompare) {
  EXPECT_TRUE(std::isinf(operation_score(example_valve(), {}, full_scale_m3_per_s)));
}

TEST(Operation, FrictionThatIsLargerThanOnTheBenchIsFound) {
  sensor::ObserverParameters<double> valve = example_valve();
  valve.friction.operation_ratio = 1;
  const recording::Recording run = triangle(valve, 1.3);
  double shown = 0;
  const OperationFit fit = fit_operation(valve, {&run}, full_scale_m3_per_s, [&](double share) { shown = share; });
  EXPECT_LT(fit.score, 0.95 * fit.score_before);
  EXPECT_GT(valve.friction.operation_ratio, 1.05);
  EXPECT_EQ(fit.samples, run.size());
  EXPECT_GT(shown, 0.9);
}

TEST(Operation, MissingReferenceSamplesAreLeftOut) {
  const sensor::ObserverParameters<double> valve = example_valve();
  recording::Recording run = triangle(valve, 1);
  const double whole = operation_score(valve, {&run}, full_scale_m3_per_s);
  run.column(Channel::flow_reference)[500] = std::nan("");
  const double score = operation_score(valve, {&run}, full_scale_m3_per_s);
  EXPECT_TRUE(std::isfinite(score));
  EXPECT_NEAR(score, whole, 0.01 * whole);
}

/// Five seconds at rest, half open, under a current that balances spring and flow force; the meter reads
/// `reference_m3_per_s`.
recording::Recording rest(const sensor::ObserverParameters<double>& valve, double reference_m3_per_s) {
  recording::Recording out;
  for (int k = 0; k < 2500; ++k) {
    out.column(Channel::time).push_back(2e-3 * k);
    out.column(Channel::current).push_back(0.5 * valve.largest_current_A);
    out.column(Channel::position).push_back(1.2e-3);
    out.column(Channel::oil_temperature).push_back(323.15);
    out.column(Channel::flow_reference).push_back(reference_m3_per_s);
  }
  return out;
}

TEST(ForceErrorRatio, GrowsWithTheErrorOfTheFlowAtRest) {
  const sensor::ObserverParameters<double> valve = example_valve();
  const recording::Recording low = rest(valve, 100 / 60e3);
  const recording::Recording high = rest(valve, 200 / 60e3);
  EXPECT_GT(force_error_ratio(valve, {&high}), 1.5 * force_error_ratio(valve, {&low}));
}

TEST(ForceErrorRatio, IsAssumedWhereTheSpoolNeverRests) {
  const sensor::ObserverParameters<double> valve = example_valve();
  recording::Recording run = triangle(valve, 1);
  for (double& reference : run.column(Channel::flow_reference)) reference = std::nan("");
  EXPECT_EQ(force_error_ratio(valve, {&run}), assumed_force_error_ratio);
}

TEST(ForceErrorRatio, ScalesWhatTheBandCounts) {
  sensor::ObserverParameters<double> valve = example_valve();
  scale_band(valve, 1);
  const auto unscaled = valve.band;
  scale_band(valve, 0.5);
  EXPECT_DOUBLE_EQ(valve.band.force_share, 0.5 * unscaled.force_share);
  EXPECT_DOUBLE_EQ(valve.band.rest_share, 0.5 * unscaled.rest_share);
  EXPECT_DOUBLE_EQ(valve.band.tolerance_N, 0.5 * unscaled.tolerance_N);
}

}  // namespace
}  // namespace spoolflow::calibration
