/// Windows of events made from the healthy model's own equations, with one magnitude changed.
#include <random>

#include <gtest/gtest.h>

#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/dense.hpp"
#include "spoolflow/monitor/direction_monitor.hpp"
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
  EXPECT_TRUE(result->shape_shows);
  EXPECT_NEAR(result->pressure_difference_Pa, 50e5, 1e5);
}

TEST(Window, AHealthyValveShowsNothing) {
  const auto result = fit_window(valve(), example().valve.stroke_m, triangle({}, 50e5));
  ASSERT_TRUE(result);
  const Isolation found = isolate(result->evidence, {}, healthy_spread);
  for (const bool there : found.likeliest) EXPECT_FALSE(there);
}

TEST(Window, EachFaultIsSeparated) {
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

TEST(Window, OneWayAloneShowsNothing) {
  EXPECT_FALSE(fit_window(valve(), example().valve.stroke_m, triangle({}, 50e5, 1)));
}

TEST(Window, FewEventsShowNothing) {
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

TEST(Window, WhatRestAddsToFrictionIsNotTakenForAFault) {
  WindowState window = triangle({}, 50e5);
  for (std::size_t k = 0; k < window.count; ++k) {
    ForceEvent& event = window.events[k];
    const Explained healthy = explain(valve(), example().valve.stroke_m, event, 50e5);
    event.net_force_N -= 0.5 * event.direction * healthy.ageing_N;  // contacts age half as much as the model's
  }
  const auto result = fit_window(valve(), example().valve.stroke_m, window);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->shape_shows);
  const Isolation found = isolate(result->evidence, {}, healthy_spread);
  for (const bool there : found.likeliest) EXPECT_FALSE(there);
}

TEST(Window, FasterStrokesLeaveFrictionLessKnown) {
  WindowState window = triangle({1, 0, 0, 0, 0, 0}, 50e5);  // 4 % of the stroke a second
  EXPECT_EQ(friction_by_speed(window, example().valve.stroke_m).unknown, 0);
  for (std::size_t k = 0; k < window.count; ++k) window.events[k].time_s /= 8;
  const SpeedEffect faster = friction_by_speed(window, example().valve.stroke_m);
  const double unknown = faster.unknown;
  EXPECT_GT(unknown, 0.2);
  EXPECT_LT(unknown, 0.4);
  EXPECT_GT(faster.less, 0.1);
  const auto result = fit_window(valve(), example().valve.stroke_m, window);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->friction_unknown, unknown);
  const Evidence loosened = with_friction_unknown(result->evidence, unknown);
  const auto deviation = [](const Evidence& evidence) {
    return score(evidence, {}, healthy_spread, Fault::friction).deviation;
  };
  EXPECT_NEAR(deviation(loosened), std::hypot(deviation(result->evidence), unknown), 1e-6);
}

TEST(EventFinder, FindsTheForceAtWhichARestingSpoolBreaksAway) {
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

TEST(EventFinder, ContactsThatCreepDoNotBreakAway) {
  FinderState state;
  std::vector<ForceEvent> found;
  const double begin_m = 0.4 * example().valve.stroke_m;
  // A jump, a rest of 0.4 s in which contacts creep by 10 um, and the break-away.
  for (int k = 0; k < 1000; ++k) {
    const int in_rest = k - 400;
    const double crept_m = in_rest < 0 ? 0 : 10e-6 * std::min(in_rest, 400) / 400;
    const double jumped_m = (in_rest >= 0 ? 40e-6 : 0) + (in_rest >= 400 ? 100e-6 : 0);
    const FinderSample sample{.time_s = 1e-3 * k,
                              .time_step_s = 1e-3,
                              .position_m = begin_m + jumped_m + crept_m,
                              .net_force_N = 10 + 2.0 * (k % 400) / 400,
                              .friction_N = 0,
                              .current_A = 1,
                              .oil_temperature_K = 323,
                              .pressure_difference_Pa = 50e5,
                              .sliding = false,
                              .dithered = false};
    const FoundEvents events = find_events(valve(), example().valve.stroke_m, state, sample);
    if (events.breakaway) found.push_back(*events.breakaway);
  }
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].rested_s, 0.4, 0.01);
}

TEST(Side, AWindowOfWanderingPressureDecidesNothingAlone) {
  WindowState window = triangle({2, 0, 0, 0, 0, 0}, 50e5);
  for (std::size_t k = 0; k < window.count; ++k) {  // the pressure walks up and down by a tenth in two seconds
    const double off_Pa = (window.events[k].time_s < 9 || window.events[k].time_s > 27 ? 8e5 : -8e5);
    window.events[k].net_force_N +=
        off_Pa * explain(valve(), example().valve.stroke_m, window.events[k], 50e5).per_pressure_N_Pa;
  }
  const auto result = fit_window(valve(), example().valve.stroke_m, window);
  ASSERT_TRUE(result);
  ASSERT_FALSE(result->shape_shows);
  DirectionReference reference{.valve = &valve(), .stroke_m = example().valve.stroke_m, .whole = false, .baseline = {}};
  DirectionState state;
  const Limits limits = limits_for(1);
  state.window = window;
  finish(reference, limits, state);
  EXPECT_FALSE(raised(state));
  state.window = window;
  finish(reference, limits, state);
  EXPECT_FALSE(raised(state));
  state.window = window;
  finish(reference, limits, state);
  EXPECT_TRUE(raised(state));
}

TEST(Side, ThreeWindowsThatMakeAFaultTenTimesLikelierRaiseIt) {
  DirectionReference reference{.valve = &valve(), .stroke_m = example().valve.stroke_m, .whole = false, .baseline = {}};
  constexpr Limits never{1e9, 1e9};  // charts of single windows decide nothing
  DirectionState state;
  for (int window = 1; window <= 3; ++window) {
    EXPECT_FALSE(raised(state));
    state.window = triangle({0, 0, 0, 0, 1.5, 0}, 50e5);
    finish(reference, never, state);
  }
  ASSERT_TRUE(raised(state));
  EXPECT_TRUE(decided(state, isolation_of(reference, state)));
  DirectionState healthy;
  for (int window = 1; window <= 6; ++window) {
    healthy.window = triangle({}, 50e5);
    finish(reference, never, healthy);
  }
  EXPECT_FALSE(raised(healthy));
}

TEST(Side, ASilentCoilEndsTheWindowOfASpoolThatFrictionHoldsOpen) {
  DirectionReference reference{.valve = &valve(), .stroke_m = example().valve.stroke_m, .whole = false, .baseline = {}};
  DirectionState state;
  state.window = triangle({}, 50e5);
  const double ended_s = state.window.events[state.window.count - 1].time_s;
  const double held_m = 0.9 * valve().closed_below_m;
  for (int k = 1; k <= 500; ++k) {
    const FinderSample motion{.time_s = ended_s + 1e-3 * k,
                              .time_step_s = 1e-3,
                              .position_m = held_m,
                              .net_force_N = 0,
                              .friction_N = 0,
                              .current_A = 0,
                              .oil_temperature_K = 323,
                              .pressure_difference_Pa = 50e5,
                              .sliding = false,
                              .dithered = false};
    take(reference, limits_for(1), state, {motion, 0, held_m, true});
  }
  EXPECT_EQ(state.windows, 1);
  EXPECT_EQ(state.window.count, 0U);
}

}  // namespace
}  // namespace spoolflow::monitor
