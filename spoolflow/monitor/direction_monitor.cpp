#include "spoolflow/monitor/direction_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/monitor/correction.hpp"
#include "spoolflow/monitor/dense.hpp"

namespace spoolflow::monitor {
namespace {

/// Resistance at work over the calibrated one, and its standard deviation: the winding warms by its own losses, and the
/// bench does not state how warm it was there. With a baseline the same, about that.
constexpr double usual_resistance_ratio = 1.04;
constexpr double resistance_spread = 0.035;
constexpr double learnt_resistance_spread = 0.025;

/// A window that identifies a magnitude worse than this [usual faults] is no point of its course.
constexpr double usual_deviation = 1;

/// A resistance that was too high is so no more below this share of the excess.
constexpr double falls_share = 0.9;
constexpr double least_winding_windows = 3;

void follow_resistance(const DirectionReference& reference, DirectionState& state) {
  const double learnt_Ohm = reference.baseline.resistance_Ohm;
  const double base_Ohm = learnt_Ohm > 0 ? learnt_Ohm : reference.valve->actuator.coil_resistance.resistance_Ohm;
  if (!(base_Ohm > 0) || state.winding.windows < least_winding_windows) return;
  const double hottest_K = learnt_Ohm > 0 ? hottest_over_baseline_K : hottest_over_calibration_K;
  const double excess_Ohm = copper_per_K * hottest_K * base_Ohm * (state.resistive ? falls_share : 1.0);
  state.resistive = state.winding.resistance_Ohm - 2 * resistance_deviation_Ohm(state.winding) > base_Ohm + excess_Ohm;
}

/// Where the pressure wanders, its step between opening and closing is as good as friction: such a window adds no more
/// than this share of the limit to the chart's sum, so that one alone decides nothing.
constexpr double share_of_unsteady = 0.5;

/// Odds from which the evidence of three windows (older ones forgotten by and by) raises a chart.
constexpr double certain_odds = 10;
constexpr double three_windows = 2.8;

/// How far a value lies beyond what healthy ones do, in standard deviations of the window.
double beyond(double value, double spread, double deviation) {
  return (value - tolerated_spreads * spread) / deviation;
}

/// One score for each chart that a window, or a reading, concerns.
void follow_charts(const DirectionReference& reference, const Limits& limits, DirectionState& state,
                   const Evidence& evidence, bool shape_shows) {
  const DirectionBaseline& base = reference.baseline;
  double against = 0;
  bool judged = false;
  for (std::size_t f = 0; f < isolated_faults; ++f) {
    if (!shape_shows && f != static_cast<std::size_t>(Fault::friction)) continue;
    const Score found = score(evidence, base.centre, base.spread, static_cast<Fault>(f));
    if (!std::isfinite(found.deviation)) continue;
    const double spread = base.spread[index(first_magnitude[f])];
    if (found.deviation < usual_deviation) follow(state.course[f], state.watched_s / 3600, found.value);
    const double most = shape_shows ? limits.single + 1 : share_of_unsteady * limits.sum + cusum_allowance;
    const double above = std::min(beyond(found.value, spread, found.deviation), most);
    follow(state.chart[f], above, cusum_allowance, limits.sum, limits.single);
    const double below = beyond(-found.value, spread, found.deviation);
    if (f == static_cast<std::size_t>(Fault::position_sensor)) {
      follow(state.chart[zero_below], below, cusum_allowance, limits.sum, limits.single);
    } else if (f != static_cast<std::size_t>(Fault::friction)) {  // faster strokes have less of it than calibrated
      against = std::max(against, below);
      judged = shape_shows;
    }
  }
  if (judged) follow(state.chart[against_faults], against, 2 * cusum_allowance, limits.sum);
}

/// A chart that has risen falls only once the evidence of all windows, too, speaks against its fault: operation that
/// identifies little of it, as faster strokes, is no repair.
void keep_explained(const DirectionReference& reference, const std::array<Cusum, charts>& before,
                    DirectionState& state) {
  for (std::size_t k = 0; k < against_faults; ++k) {
    if (!before[k].raised || state.chart[k].raised) continue;
    const std::size_t fault = std::min(k, isolated_faults - 1);
    state.chart[k].raised = isolation_of(reference, state).odds[fault] >= 1;
  }
}

/// A chart rises, too, where all windows of steady pressure, three and more, make its fault that likely.
void raise_explained(const DirectionReference& reference, const Limits& limits, DirectionState& state) {
  if (state.learnt.shape.weight < three_windows) return;
  const Isolation found = isolation_of(reference, state);
  for (std::size_t f = 0; f < isolated_faults; ++f) {
    if (found.odds[f] < certain_odds) continue;
    const bool below =
        first_magnitude[f] == Magnitude::position_zero &&
        found.value[index(Magnitude::position_zero)] < reference.baseline.centre[index(Magnitude::position_zero)];
    Cusum& chart = state.chart[below ? zero_below : f];
    chart.sum = std::max(chart.sum, limits.sum);
    chart.raised = true;
  }
}

void close(const DirectionReference& reference, const Limits& limits, DirectionState& state,
           const std::optional<WindowResult>& result) {
  if (!result) return;
  ++state.windows;
  state.pressure_Pa = result->pressure_difference_Pa;
  learn(state.contacts, result->contact);
  learn(result->shape_shows ? state.learnt.shape : state.learnt.friction,
        with_friction_unknown(result->evidence, result->friction_unknown));
  const std::array<Cusum, charts> before = state.chart;
  follow_charts(reference, limits, state, result->evidence, result->shape_shows);
  keep_explained(reference, before, state);
  raise_explained(reference, limits, state);
}

/// The position sensor's two charts, by a reading of where the spool rests [m].
void judge_rest(const DirectionReference& reference, const Limits& limits, DirectionState& state, double position_m,
                double deviation_m) {
  const std::size_t k = index(Magnitude::position_zero);
  const double unit_m = usual_fault[k];
  const double value = position_m / unit_m - reference.baseline.centre[k];
  const double deviation = deviation_m / unit_m;
  const double spread = reference.baseline.spread[k];
  follow(state.chart[static_cast<std::size_t>(Fault::position_sensor)], (value - spread) / deviation, cusum_allowance,
         limits.sum);
  follow(state.chart[zero_below], (-value - spread) / deviation, cusum_allowance, limits.sum);
}

/// The closed stop, once for each time that the coil falls silent.
void follow_rest(const DirectionReference& reference, const Limits& limits, DirectionState& state,
                 const DirectionSample& sample) {
  RestReading& rest = state.learnt.rest;
  const double from_stop_m = sample.motion.position_m - closed_stop_m(*reference.valve);
  const bool silent = sample.motion.current_A < silent_current_share * reference.valve->largest_current_A &&
                      std::abs(from_stop_m) < farthest_rest_m;
  if (!silent) {
    rest.silent_s = rest.sum_m = rest.sum_s = 0;
    return;
  }
  const double before_s = rest.silent_s;
  rest.silent_s += sample.motion.time_step_s;
  if (before_s >= rest_ends_s || rest.silent_s < rest_begins_s) return;
  rest.sum_m += from_stop_m * sample.motion.time_step_s;
  rest.sum_s += sample.motion.time_step_s;
  if (rest.silent_s < rest_ends_s || !(rest.sum_s > 0)) return;
  const double position_m = rest.sum_m / rest.sum_s;
  const double left = 1 - 1 / memory_windows;
  rest.weight = rest.weight * left + 1;
  rest.mean_m += (position_m - rest.mean_m) / rest.weight;
  const bool lowest = rest.weight <= 1 || position_m < rest.lowest_m;
  rest.lowest_m = lowest ? position_m : rest.lowest_m + lowest_forgetting * (position_m - rest.lowest_m);
  if (rest.weight <= 1) return;  // the first may be held by friction
  judge_rest(reference, limits, state, rest.lowest_m, rest_deviation_m);
}

void follow_closing(const DirectionReference& reference, const Limits& limits, DirectionState& state,
                    const DirectionSample& sample) {
  constexpr double closed_share = 0.6;
  const double stop_m = closed_stop_m(*reference.valve);
  // Friction holds a worn spool open: then the silent coil says that it is meant to be closed.
  const bool silent = sample.motion.current_A < silent_current_share * reference.valve->largest_current_A;
  const bool closed =
      silent || sample.motion.position_m - stop_m < closed_share * (reference.valve->closed_below_m - stop_m);
  const double before_s = state.window.closed_s;
  state.window.closed_s = closed ? before_s + sample.motion.time_step_s : 0;
  if (closed && before_s < closing_pause_s && state.window.closed_s >= closing_pause_s && state.window.count > 0)
    close(reference, limits, state, end_window(*reference.valve, reference.stroke_m, state.window));
}

Limits reckoned_limits(double false_alarms_per_year) {
  const double run_length = 2 * windows_per_year * static_cast<double>(charts) / false_alarms_per_year;
  return {limit_for(cusum_allowance, run_length), single_limit_for(run_length)};
}

}  // namespace

Limits limits_for(double false_alarms_per_year) {
  constexpr double usual = 1;
  static const Limits usual_limits = reckoned_limits(usual);  // once for all valves
  return false_alarms_per_year == usual ? usual_limits : reckoned_limits(false_alarms_per_year);
}

void take(const DirectionReference& reference, const Limits& limits, DirectionState& state,
          const DirectionSample& sample) {
  if (!sample.follows) {
    leave(state);
    return;
  }
  state.watched_s += sample.motion.time_step_s;
  if (std::isfinite(sample.voltage_V)) {
    if (follow_winding(reference.valve->actuator, reference.valve->largest_current_A, state.winding,
                       {sample.motion.time_step_s, sample.motion.current_A, sample.voltage_V, sample.raw_position_m,
                        sample.motion.oil_temperature_K}))
      follow_resistance(reference, state);
  } else {
    begin_winding_window(state.winding);
  }
  if (!reference.whole) follow_rest(reference, limits, state, sample);
  follow_closing(reference, limits, state, sample);
  const FoundEvents found = find_events(*reference.valve, reference.stroke_m, state.finder, sample.motion);
  for (const std::optional<ForceEvent>& event : {found.breakaway, found.slide}) {
    if (!event) continue;
    close(reference, limits, state, add_event(*reference.valve, reference.stroke_m, state.window, *event));
  }
}

namespace {

/// Both sides have new readings: the middle is judged, for both directions, to a's springs mirrored.
void judge_centre(const std::array<DirectionReference, 2>& reference, const Limits& limits,
                  std::array<DirectionState, 2>& sides, CentreRest& rest) {
  rest.back[0].paired = rest.back[1].paired = true;
  rest.pairs = rest.pairs * (1 - 1 / memory_windows) + 1;
  const double middle_m = 0.5 * (rest.back[0].newest_m + rest.back[1].newest_m);
  const double deviation_m = centre_deviation_m(rest);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const double sign = k == 0 ? 1 : -1;
    RestReading& reading = sides[k].learnt.rest;
    reading.mean_m = reading.lowest_m = sign * centre_zero_m(rest);
    reading.deviation_m = deviation_m;
    reading.weight = rest.pairs;
    if (rest.pairs > 1) judge_rest(reference[k], limits, sides[k], sign * middle_m, deviation_m);
  }
}

}  // namespace

void take_centre(const std::array<DirectionReference, 2>& reference, const Limits& limits,
                 std::array<DirectionState, 2>& sides, CentreRest& rest, const CentreSample& sample) {
  const bool open = std::abs(sample.position_m) > farthest_centre_m;
  if (open) rest.from = sample.position_m > 0 ? 0 : 1;
  if (open || !sample.silent) {
    leave(rest);
    return;
  }
  const double before_s = rest.silent_s;
  rest.silent_s += sample.time_step_s;
  if (before_s >= rest_ends_s || rest.silent_s < rest_begins_s) return;
  rest.sum_m += sample.position_m * sample.time_step_s;
  rest.sum_s += sample.time_step_s;
  if (rest.silent_s < rest_ends_s || !(rest.sum_s > 0) || rest.from < 0) return;
  CentreRest::Back& back = rest.back[static_cast<std::size_t>(rest.from)];
  back.newest_m = rest.sum_m / rest.sum_s;
  back.weight = back.weight * (1 - 1 / memory_windows) + 1;
  back.mean_m += (back.newest_m - back.mean_m) / back.weight;
  back.paired = false;
  rest.from = -1;  // the next reading needs another stroke
  if (!rest.back[0].paired && !rest.back[1].paired) judge_centre(reference, limits, sides, rest);
}

void leave(CentreRest& rest) {
  rest.silent_s = rest.sum_m = rest.sum_s = 0;
}

void leave(DirectionState& state) {
  interrupt(state.finder);
  begin_winding_window(state.winding);
  state.learnt.rest.silent_s = state.learnt.rest.sum_m = state.learnt.rest.sum_s = 0;
}

void finish(const DirectionReference& reference, const Limits& limits, DirectionState& state) {
  if (state.window.count > 0)
    close(reference, limits, state, end_window(*reference.valve, reference.stroke_m, state.window));
  leave(state);
}

Evidence evidence_of(const DirectionReference& reference, const DirectionState& state) {
  Evidence out = evidence_of(state.learnt);
  const double learnt_Ohm = reference.baseline.resistance_Ohm;
  const double calibrated_Ohm = reference.valve->actuator.coil_resistance.resistance_Ohm;
  const double expected_Ohm = learnt_Ohm > 0 ? learnt_Ohm : usual_resistance_ratio * calibrated_Ohm;
  if (state.winding.windows > 0 && expected_Ohm > 0) {
    const double unit = usual_fault[index(Magnitude::shorted_turns)];
    const double spread = learnt_Ohm > 0 ? learnt_resistance_spread : resistance_spread;
    add(out,
        {reading(Magnitude::shorted_turns, (1 - state.winding.resistance_Ohm / expected_Ohm) / unit, spread / unit),
         1});
  }
  return out;
}

Isolation isolation_of(const DirectionReference& reference, const DirectionState& state) {
  return isolate(evidence_of(reference, state), reference.baseline.centre, reference.baseline.spread);
}

bool raised(const DirectionState& state) {
  return std::ranges::any_of(state.chart, [](const Cusum& chart) { return chart.raised; });
}

bool decided(const DirectionState& state, const Isolation& found) {
  const double likeliest = *std::ranges::max_element(found.odds);
  return raised(state) && (likeliest > least_reported_odds || found.unexplained_odds >= 1);
}

DirectionBaseline baseline_of(const DirectionReference& reference, const DirectionState& state) {
  constexpr double share_left = 0.3;  // of the healthy spread: the same maps and signatures are wrong the same way
  DirectionBaseline out;
  const Evidence evidence = evidence_of(state.learnt);
  MagnitudeMatrix factor = evidence.information;
  for (std::size_t k = 0; k < magnitudes; ++k)
    factor[k * magnitudes + k] += 1 / (reference.healthy[k] * reference.healthy[k]);
  if (factorise(factor, magnitudes)) {
    out.centre = evidence.pull;
    solve_in_place(factor, magnitudes, out.centre);
    for (std::size_t k = 0; k < magnitudes; ++k) {
      Magnitudes unit{};
      unit[k] = 1;
      solve_in_place(factor, magnitudes, unit);
      out.spread[k] = std::sqrt(unit[k] + std::pow(share_left * healthy_spread[k], 2));
    }
  }
  out.windows = state.windows;
  out.resistance_Ohm = state.winding.windows > 0 ? state.winding.resistance_Ohm : 0;
  return out;
}

}  // namespace spoolflow::monitor
