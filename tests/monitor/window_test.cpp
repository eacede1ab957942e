/// Windows of events made from the healthy model's own equations, with one magnitude changed.
#include <random>

#include <gtest/gtest.h>

#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/dense.hpp"
#include "spoolflow/monitor/event_finder.hpp"
#include "spoolflow/monitor/event_window.hpp"
#include "spoolflow/monitor/isolation.hpp"
#include "tests/monitor/example.hpp"

namespace spoolflow::monitor {
namespace {

const sensor::ObserverParameters<double>& valve() {
  return example().observer->parameters;
}

/// A triangle of break-aways after 0.2 s each, at a pressure difference that nobody knows, with noise of a tenth of a
/// newton.
WindowState triangle(const Magnitudes& magnitudes_there, double pressure_Pa, int ways = 2) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> noise(0, 0.1);
  WindowState out;
  for (int k = 0; k < 30 * ways; ++k) {
    const bool opens = k < 30;
    const double share = opens ? k / 30.0 : (59 - k) / 30.0;
    ForceEvent event{.time_s = 0.6 * k,
                     .position_m = (0.05 + 0.8 * share) * example().valve.stroke_m,
                     .net_force_N = 0,
                     .rested_s = 0.2,
                     .friction_N = 0,
                     .current_A = 0.6 + 1.2 * share,
                     .oil_temperature_K = 323,
                     .pressure_difference_Pa = 0.7 * pressure_Pa,  // the sensor is wrong
                     .direction = opens ? 1.0 : -1.0,
                     .count = 1,
                     .kind = EventKind::breakaway};
    const Explained healthy = explain(valve(), example().valve.stroke_m, event, pressure_Pa);
    event.net_force_N = -healthy.residual_N + product(healthy.slope_N, magnitudes_there) + noise(generator);
    out.events[out.count++] = event;
  }
  return out;
}

TEST(Window, FindsThePressureDifferenceThatNobodyMeasures) {
  const auto result = fit_window(valve(), example().valve.stroke_m, triangle({}, 50e5));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->shape_tells);
  EXPECT_NEAR(result->pressure_difference_Pa, 50e5, 1e5);
}

TEST(Window, AHealthyValveShowsNothing) {
  const auto result = fit_window(valve(), example().valve.stroke_m, triangle({}, 50e5));
  ASSERT_TRUE(result);
  const Isolation found = isolate(result->evidence, {}, healthy_spread);
  for (const bool there : found.likeliest) EXPECT_FALSE(there);
}

TEST(Window, EachFaultIsToldApart) {
  const std::array<std::pair<Magnitudes, Fault>, 4> cases{{{{1, 0, 0, 0, 0, 0}, Fault::friction},
                                                           {{0, 1.5, 0, 0, 0, 0}, Fault::edge_wear},
                                                           {{0, 0, 1, 1, 0, 0}, Fault::spring},
                                                           {{0, 0, 0, 0, 1.5, 0}, Fault::coil}}};
  for (const auto& [there, fault] : cases) {
    const auto result = fit_window(valve(), example().valve.stroke_m, triangle(there, 50e5));
    ASSERT_TRUE(result) << name(fault);
    const Isolation found = isolate(result->evidence, {}, healthy_spread);
    const auto best = std::max_element(found.odds.begin(), found.odds.end()) - found.odds.begin();
    EXPECT_EQ(name(static_cast<Fault>(best)), name(fault));
    EXPECT_GT(found.odds[static_cast<std::size_t>(fault)], 1) << name(fault);
  }
}

TEST(Window, FasterStrokesWithLessFrictionAreNoWrongModel) {
  const auto result = fit_window(valve(), example().valve.stroke_m, triangle({-0.7, 0, 0, 0, 0, 0}, 50e5));
  ASSERT_TRUE(result);
  const Isolation found = isolate(result->evidence, {}, healthy_spread);
  EXPECT_LT(found.unexplained_odds, 1);
  for (const bool there : found.likeliest) EXPECT_FALSE(there);
}

TEST(Window, StrongerSpringsAreExplainedByNoFault) {
  const auto result = fit_window(valve(), example().valve.stroke_m, triangle({0, 0, -1.5, -1.5, 0, 0}, 50e5));
  ASSERT_TRUE(result);
  EXPECT_GT(isolate(result->evidence, {}, healthy_spread).unexplained_odds, 1);
}

TEST(Window, OneWayAloneTellsNothing) {
  EXPECT_FALSE(fit_window(valve(), example().valve.stroke_m, triangle({}, 50e5, 1)));
}

TEST(Window, FewEventsTellNothing) {
  WindowState window = triangle({}, 50e5);
  window.count = least_window_events - 1;
  EXPECT_FALSE(fit_window(valve(), example().valve.stroke_m, window));
}

TEST(Window, AHuntingSpoolsEventsAreMergedEachWay) {
  WindowState window;
  ForceEvent event = triangle({}, 50e5).events[10];
  for (int k = 0; k < 6; ++k) {
    event.direction = k % 2 == 0 ? 1 : -1;
    event.time_s += 0.1;
    EXPECT_FALSE(add_event(valve(), example().valve.stroke_m, window, event));
  }
  EXPECT_EQ(window.count, 2U);
  EXPECT_EQ(window.events[0].count, 3);
}

TEST(EventFinder, TellsTheForceAtWhichARestingSpoolBreaksAway) {
  FinderState state;
  std::vector<ForceEvent> found;
  double position_m = 0.4 * example().valve.stroke_m;
  const double begin_m = position_m;
  // Two rests of 0.4 s, each ended by a jump of 30 um once the force has risen by 2 N.
  for (int k = 0; k < 1600; ++k) {
    const int in_rest = k % 400;
    if (k > 0 && in_rest == 0) position_m += 30e-6;
    const FinderSample sample{.time_s = 1e-3 * k,
                              .time_step_s = 1e-3,
                              .position_m = position_m,
                              .net_force_N = 10 + 2.0 * in_rest / 400,
                              .friction_N = 0,
                              .current_A = 1,
                              .oil_temperature_K = 323,
                              .pressure_difference_Pa = 50e5,
                              .sliding = false,
                              .dithered = false};
    const FoundEvents events = find_events(valve(), example().valve.stroke_m, state, sample);
    if (events.breakaway) found.push_back(*events.breakaway);
  }
  ASSERT_EQ(found.size(), 2U);  // how long the first rest had lasted nobody knows
  EXPECT_NEAR(found[0].net_force_N, 12, 0.05);
  EXPECT_NEAR(found[0].rested_s, 0.4, 0.01);
  EXPECT_EQ(found[0].direction, 1);
  EXPECT_NEAR(found[0].position_m, begin_m + 30e-6, 1e-9);
}

}  // namespace
}  // namespace spoolflow::monitor
