#include "spoolflow/calibration/flow_bench/flow_bench_fit.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/calibration/flow_bench/coenergy.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using testing::HasSubstr;

/// A valve in closed form: flux linkage i (L0 + L1 x), so that its coenergy pulls with i^2 L1/2 everywhere.
constexpr double inductance_H = 0.06, inductance_per_m = 30, resistance_Ohm = 3, driven_stroke_m = 2.4e-3;
constexpr double force_per_A2 = 0.5 * inductance_per_m;

double spring_at(double x) {
  return 9 + 12e3 * x;
}
double flow_force_at(double x, double pressure_Pa) {
  return 2.5e-3 * std::fmax(0.0, x - 0.3e-3) * pressure_Pa;
}
double friction_at(double x, double pressure_Pa) {
  return 2.0 + 3e-4 * x * pressure_Pa;
}

struct StrokesLike {
  double flow_force_share = 1;        ///< of an edge with so much of the flow force
  double sticks_above_Pa = INFINITY;  ///< from there on the spool does not slide evenly, but sticks and slips
  double stroke_s = 3;
  double coil_Ohm = resistance_Ohm, warms_Ohm_per_s = 0;
  double voltage_noise_V = 0.01;
};

/// Where a spool that sticks and slips by `slip_m` each time stands on its way to `x`, and what friction then exceeds
/// that of sliding by: it rises while the spool sticks, and falls as it slips.
std::pair<double, double> sticking_at(double x, double direction) {
  constexpr double slip_m = 30e-6, swing_N = 1.5, stick_share = 0.8;
  const double slips = (direction > 0 ? x : driven_stroke_m - x) / slip_m;
  const double since = slips - std::floor(slips);  // the last slip
  const double slipped = std::fmax(0.0, (since - stick_share) / (1 - stick_share));
  const double swing = since < stick_share ? since / stick_share : 1 - slipped;
  return {x - direction * (since - slipped) * slip_m, swing_N * (2 * swing - 1)};
}

/// Strokes both ways at each pressure difference, a rest at either end.
recording::Recording strokes(const std::vector<double>& pressures_Pa, bool with_voltage, StrokesLike like = {}) {
  constexpr double sampling_s = 2e-3;
  recording::Recording out;
  out.file = "strokes.csv";
  std::mt19937 generator(3);
  std::normal_distribution<double> unit(0, 1);
  double flux_Wb = 0, time_s = 0;
  const auto put = [&](double on_the_way_m, double direction, double pressure_Pa) {
    const bool sticks = pressure_Pa > like.sticks_above_Pa && direction != 0;
    const auto [x, more_N] = sticks ? sticking_at(on_the_way_m, direction) : std::pair{on_the_way_m, 0.0};
    const double force_N = spring_at(x) + like.flow_force_share * flow_force_at(x, pressure_Pa) +
                           direction * (friction_at(x, pressure_Pa) + more_N);
    const double current_A = direction == 0 ? 0 : std::sqrt(force_N / force_per_A2);
    const double now_Wb = current_A * (inductance_H + inductance_per_m * x);
    out.column(Channel::time).push_back(time_s += sampling_s);
    out.column(Channel::position).push_back(x + 0.7e-6 * unit(generator));
    out.column(Channel::current).push_back(current_A + 1e-3 * unit(generator));
    if (with_voltage)
      out.column(Channel::voltage)
          .push_back((like.coil_Ohm + like.warms_Ohm_per_s * time_s) * current_A + (now_Wb - flux_Wb) / sampling_s +
                     like.voltage_noise_V * unit(generator));
    out.column(Channel::pressure_difference).push_back(pressure_Pa);
    out.column(Channel::oil_temperature).push_back(323.15);
    flux_Wb = now_Wb;
  };
  for (const double pressure_Pa : pressures_Pa) {
    const int samples = static_cast<int>(like.stroke_s / sampling_s);
    for (int k = 0; k < 200; ++k) put(0, 0, pressure_Pa);
    for (int k = 0; k <= samples; ++k) put(driven_stroke_m * k / samples, 1, pressure_Pa);
    for (int k = samples; k >= 0; --k) put(driven_stroke_m * k / samples, -1, pressure_Pa);
  }
  return out;
}

TEST(Coenergy, OfALinearInductancePullsWithHalfItsSlopeTimesTheSquareOfTheCurrent) {
  sensor::FluxLinkage<double> linkage;
  linkage.map.row_axis = {-0.2, 0.1, 10};
  linkage.map.column_axis = {0, driven_stroke_m / 8, 8 / driven_stroke_m};
  for (int row = 0; row < sensor::flux_map_currents; ++row)
    for (int column = 0; column < sensor::flux_map_positions; ++column)
      linkage.map.node(row, column) =
          linkage.map.row_axis.at(row) * (inductance_H + inductance_per_m * linkage.map.column_axis.at(column));
  const sensor::MagneticForce<double> force = force_of_coenergy(linkage);
  for (const double x : {0.0, 0.5e-3, 1.7e-3, 2.4e-3}) {
    const double node_A = force.map.row_axis.at(20);
    EXPECT_NEAR(force.at(node_A, x).value, force_per_A2 * node_A * node_A, 1e-6);
  }
}

TEST(FlowBenchFit, FindsTheForcesInNewtonsFromVoltageAndMotionAlone) {
  const recording::Recording dry = strokes({0, 0}, true);
  const recording::Recording metering = strokes({5e5, 2e6, 4e6, 6e6}, true);
  const FlowBenchFit fit = fit_flow_bench({{&dry}, {&metering}, {}}, {}, driven_stroke_m);
  const auto at = [&](const Knots& knots, double x, const auto& place) {
    const Knots::Place here = knots.at(x);
    return (1 - here.share) * fit.forces.unknowns(place(here.lower)) +
           here.share * fit.forces.unknowns(place(here.lower + 1));
  };
  const ForceLayout& layout = fit.layout;
  const auto force_at = [&](int k) { return layout.force_at(0, k); };
  const auto dry_at = [&](int k) { return layout.dry_at(0, k); };
  for (const double x : {0.9e-3, 1.5e-3, 2.1e-3}) {
    EXPECT_NEAR(at(layout.force, x, force_at), 1e5 * flow_force_at(x, 1), 0.08 * 1e5 * flow_force_at(x, 1));
    const double current_A = std::sqrt(spring_at(x) / force_per_A2);
    // Slow strokes alone do not separate friction from hysteresis: together they are what stands between both
    // directions.
    const double loop_N = sensor::saturated_output(fit.coil.hysteresis, 0.5) * 2 * force_per_A2 * current_A;
    EXPECT_NEAR(at(layout.dry, x, dry_at) + loop_N, 2.0, 0.4);
    EXPECT_NEAR(
        fit.magnetic_force.at(current_A, x).value - at(layout.spring, x, [&](int k) { return layout.spring_at(k); }), 0,
        0.5);
  }
  EXPECT_LT(fit.forces.residual_N, 0.2);
  EXPECT_NEAR(fit.flux_linkage.coil_resistance.resistance_Ohm, resistance_Ohm, 0.03);
}

/// Of a stroke of 12 s the flux induces some 10 mV, beside 30 V over a coil that warms.
TEST(FlowBenchFit, FindsNewtonsInSlowStrokesOfACoilThatWarms) {
  const StrokesLike slow{.stroke_s = 12, .coil_Ohm = 12, .warms_Ohm_per_s = 2e-3, .voltage_noise_V = 0.03};
  const recording::Recording dry = strokes({0, 0}, true, slow), metering = strokes({5e5, 2e6, 4e6, 6e6}, true, slow);
  const FlowBenchFit fit = fit_flow_bench({{&dry}, {&metering}, {}}, {}, driven_stroke_m);
  for (const double x : {0.6e-3, 1.2e-3, 1.8e-3}) {
    for (const double current_A : {1.4, 1.8}) {
      const double force_N = force_per_A2 * current_A * current_A;
      EXPECT_NEAR(fit.magnetic_force.at(current_A, x).value, force_N, 0.1 * force_N) << x << ' ' << current_A;
    }
  }
}

/// The closed form's solenoid as force benches measure it.
ActuatorFit measured_actuator() {
  constexpr double largest_A = 3;
  ActuatorFit out{};
  sensor::ActuatorParameters<double>& actuator = out.actuator;
  const auto stretch = [](auto& map, double rows, double columns) {
    map.row_axis = {0, rows, 1 / rows};
    map.column_axis = {0, columns, 1 / columns};
  };
  auto& force = actuator.magnetic_force.map;
  stretch(force, largest_A / (sensor::force_map_currents - 1), driven_stroke_m / (sensor::force_map_positions - 1));
  actuator.friction_N = force;
  for (int row = 0; row < sensor::force_map_currents; ++row) {
    for (int column = 0; column < sensor::force_map_positions; ++column)
      force.node(row, column) = force_per_A2 * force.row_axis.at(row) * force.row_axis.at(row);
  }
  auto& flux = actuator.coil.flux_linkage.map;
  stretch(flux, largest_A / (sensor::flux_map_currents - 1), driven_stroke_m / (sensor::flux_map_positions - 1));
  for (int row = 0; row < sensor::flux_map_currents; ++row) {
    for (int column = 0; column < sensor::flux_map_positions; ++column)
      flux.node(row, column) = flux.row_axis.at(row) * (inductance_H + inductance_per_m * flux.column_axis.at(column));
  }
  actuator.coil.hysteresis = default_hysteresis(0, 0.4);
  return out;
}

/// Slow strokes under pressure creep by sticking and slipping on many valves.
TEST(FlowBenchFit, ASpoolThatSticksAndSlipsShowsTheFrictionOfSlidingOnTheAverage) {
  const recording::Recording dry = strokes({0, 0}, true);
  const recording::Recording metering = strokes({5e5, 2e6, 4e6, 6e6}, true, {.sticks_above_Pa = 1e5});
  EXPECT_LT(track_run(metering, driven_stroke_m, true).sliding.size(), 100U);
  MeasuredForces measured;
  measured.actuator = measured_actuator();
  const FlowBenchFit fit = fit_flow_bench({{&dry}, {&metering}, {}}, measured, driven_stroke_m);
  const ForceLayout& layout = fit.layout;
  for (const int k : {3, 5, 7}) {
    const double x = driven_stroke_m * k / (layout.loaded.count - 1);
    EXPECT_NEAR(fit.forces.unknowns(layout.loaded_at(0, k)), 1e5 * 3e-4 * x, 0.1 * 1e5 * 3e-4 * x) << x;
    EXPECT_NEAR(fit.forces.unknowns(layout.force_at(0, 4 * k)), 1e5 * flow_force_at(x, 1),
                0.05 * 1e5 * flow_force_at(x, 1))
        << x;
  }
}

TEST(FlowBenchFit, ASpoolThatIsHeldOnItsWayDoesNotPass) {
  recording::Recording run = strokes({4e6}, true);
  constexpr std::size_t middle = 600;                  // on the way to open, ...
  for (std::size_t k = middle; k < middle + 500; ++k)  // ... for a second
    run.column(Channel::position)[k] =
        run.column(Channel::position)[middle] + 1e-6 * std::sin(2.0 * static_cast<double>(k));
  const std::vector<SlidingSample> passing = track_run(run, driven_stroke_m, true).passing;
  EXPECT_GT(passing.size(), 500U);
  for (const SlidingSample& each : passing) EXPECT_FALSE(each.sample > middle + 20 && each.sample < middle + 500);
}

TEST(FlowBenchFit, GivesEachEdgeThatIsMeteredAloneItsOwnFlowForce) {
  const recording::Recording dry = strokes({0, 0}, true);
  const recording::Recording inlet = strokes({5e5, 2e6, 4e6, 6e6}, true),
                             outlet = strokes({5e5, 3e6, 6e6}, true, {.flow_force_share = 0.6});
  const FlowBenchFit fit = fit_flow_bench({{&dry}, {&inlet}, {}, {&outlet}}, {}, driven_stroke_m);
  const ForceLayout& layout = fit.layout;
  ASSERT_EQ(layout.layers(), 2);
  for (int k = 12; k < 30; k += 4) {
    const double of_inlet = fit.forces.unknowns(layout.force_at(0, k)),
                 of_outlet = fit.forces.unknowns(layout.force_at(1, k));
    const double x = driven_stroke_m * k / (layout.force.count - 1);
    const double expected = 1e5 * flow_force_at(x, 1) / spring_at(x);  // newtons drop out
    EXPECT_NEAR(of_inlet / fit.forces.unknowns(layout.spring_at(k / 2)), expected, 0.12 * expected);
    EXPECT_NEAR(of_outlet / of_inlet, 0.6, 0.03);
  }
  EXPECT_LT(fit.forces.residual_N, 0.2);
}

TEST(FlowBenchFit, KeepsASpringThatAForceBenchMeasured) {
  const recording::Recording dry = strokes({0, 0}, true);
  const recording::Recording metering = strokes({5e5, 4e6}, true);
  MeasuredForces measured;
  SpringFit& spring = measured.spring.emplace();
  spring.spring.curve.axis = {0, driven_stroke_m / (sensor::spring_positions - 1),
                              (sensor::spring_positions - 1) / driven_stroke_m};
  for (int k = 0; k < sensor::spring_positions; ++k)
    spring.spring.curve.values[static_cast<std::size_t>(k)] = spring_at(spring.spring.curve.axis.at(k));
  const FlowBenchFit fit = fit_flow_bench({{&dry}, {&metering}, {}}, measured, driven_stroke_m);
  for (int k = 2; k + 2 < fit.layout.spring.count; ++k)
    EXPECT_NEAR(fit.forces.unknowns(fit.layout.spring_at(k)),
                spring_at(driven_stroke_m * k / (fit.layout.spring.count - 1)), 0.4);
}

/// What an axial-force rig whose load cell shows `factor` times the force measures.
AxialForceFit axial_force(double factor, double oil_temperature_K) {
  AxialForceFit out{{}, oil_temperature_K, {}, {}};
  for (const double pressure_Pa : {1e6, 3e6, 6e6}) {
    model::AxialForceLoop& loop = out.loops.emplace_back();
    for (int k = 0; k < sensor::flow_map_positions; ++k) {
      const double x = driven_stroke_m * k / (sensor::flow_map_positions - 1);
      loop.position_m.push_back(x);
      loop.opening_N.push_back(factor * (spring_at(x) + flow_force_at(x, pressure_Pa) + friction_at(x, pressure_Pa)));
      loop.closing_N.push_back(factor * (spring_at(x) + flow_force_at(x, pressure_Pa) - friction_at(x, pressure_Pa)));
      loop.pressure_difference_Pa.push_back(pressure_Pa);
      loop.flow_m3_per_s.push_back(1e-7 * x / driven_stroke_m * std::sqrt(pressure_Pa));
    }
  }
  return out;
}

TEST(FlowBenchFit, TakesTheScaleOfAllForcesFromOneThatWasMeasured) {
  const recording::Recording dry = strokes({0, 0}, true);
  const recording::Recording metering = strokes({5e5, 2e6, 4e6, 6e6}, true);
  constexpr double factor = 1.1;
  MeasuredForces measured;
  measured.axial = {axial_force(factor, 343.15)};  // at another oil temperature
  const FlowBenchFit fit = fit_flow_bench({{&dry}, {&metering}, {}}, measured, driven_stroke_m);
  ASSERT_EQ(fit.layout.layers(), 2);
  for (const int k : {12, 20, 28}) {
    const double x = driven_stroke_m * k / (fit.layout.force.count - 1);
    for (const int layer : {0, 1})
      EXPECT_NEAR(fit.forces.unknowns(fit.layout.force_at(layer, k)), factor * 1e5 * flow_force_at(x, 1),
                  0.06 * 1e5 * flow_force_at(x, 1))
          << layer << ", " << x;
    const double current_A = std::sqrt(spring_at(x) / force_per_A2);
    EXPECT_NEAR(fit.magnetic_force.at(current_A, x).value, factor * spring_at(x), 0.03 * spring_at(x)) << x;
  }
}

TEST(FlowBenchFit, WithoutTheCoilsVoltageAsksForItOrForAForceMap) {
  const recording::Recording dry = strokes({0}, false);
  const recording::Recording metering = strokes({1e6, 4e6}, false);
  try {
    (void)fit_flow_bench({{&dry}, {&metering}, {}}, {}, driven_stroke_m);
    FAIL() << "no refusal";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("give \"voltage\""));
  }
}

TEST(FlowBenchFit, LeavesOutSamplesUnderDitherWhichHidesFriction) {
  recording::Recording run = strokes({4e6}, true);
  EXPECT_GT(track_run(run, driven_stroke_m, true).sliding.size(), 1000U);
  for (std::size_t k = 0; k < run.size(); ++k)
    run.column(Channel::current)[k] += 0.1 * std::sin(2 * 3.14159265 * 100 * run.column(Channel::time)[k] + 0.4);
  EXPECT_LT(track_run(run, driven_stroke_m, true).sliding.size(), 20U);
}

TEST(FlowBenchFit, RefusesAValveThatHardlyMoves) {
  recording::Recording still = strokes({0}, true);
  for (double& x : still.column(Channel::position)) x = 1e-3 * 0;
  try {
    (void)fit_flow_bench({{&still}, {&still}, {}}, {}, driven_stroke_m);
    FAIL() << "no refusal";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("slides in 0 samples only"));
  }
}

}  // namespace
}  // namespace spoolflow::calibration
