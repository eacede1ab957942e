#include "spoolflow/monitor/indicators.hpp"

#include <cmath>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::monitor {
namespace {

constexpr double unknown = estimation::not_measured;
/// A trend's limit, in usual faults.
constexpr double trend_limit = 2;

/// One name a side.
struct Names {
  std::string_view b, a;
  [[nodiscard]] std::string_view of(bool side_a) const { return side_a ? a : b; }
};

struct InItsUnit {
  Names names;
  Magnitude magnitude;
  Fault fault;
  double factor;  ///< from usual_fault to the indicator's unit
  double at_zero;
  std::string_view unit;
};
constexpr std::array<InItsUnit, magnitudes> in_its_unit{{
    {{"friction_ratio", "friction_ratio_a"}, Magnitude::friction, Fault::friction, 1, 1, "1"},
    {{"edge_rounding", "edge_rounding_a"}, Magnitude::edge_rounding, Fault::edge_wear, 1, 0, "m"},
    {{"spring_preload_ratio", "spring_preload_ratio_a"}, Magnitude::preload_loss, Fault::spring, -1, 1, "1"},
    {{"spring_rate_ratio", "spring_rate_ratio_a"}, Magnitude::rate_loss, Fault::spring, -1, 1, "1"},
    {{"shorted_turns", "shorted_turns_a"}, Magnitude::shorted_turns, Fault::coil, 1, 0, "1"},
    {{"position_zero", "position_zero_a"}, Magnitude::position_zero, Fault::position_sensor, 1, 0, "m"},
}};

Trend trend_of(const DirectionReference& reference, const DirectionState& side, const InItsUnit& each) {
  const auto fault = static_cast<std::size_t>(each.fault);
  if (first_magnitude[fault] != each.magnitude) return {};
  const std::size_t k = index(each.magnitude);
  const Line line = line_through(side.course[fault], reference.baseline.spread[k]);
  if (!line.there) return {};
  const double unit = each.factor * usual_fault[k];
  const double limit = line.slope_per_h > 0 ? trend_limit : -trend_limit;
  const TimeToLimit time = time_to(line, limit);
  return {true,
          unit * line.slope_per_h,
          2 * std::abs(unit) * line.slope_deviation,
          each.at_zero + unit * (limit + reference.baseline.centre[k]),
          time.earliest_h,
          time.expected_h,
          time.latest_h};
}

}  // namespace

AlarmLimits alarm_limits(const Indicator& indicator) {
  for (const InItsUnit& each : in_its_unit) {
    if (indicator.name != each.names.b && indicator.name != each.names.a) continue;
    const double tolerated = each.factor * tolerated_spreads * indicator.spread;
    const double beyond = indicator.baseline + tolerated;
    if (each.magnitude == Magnitude::position_zero) return {indicator.baseline - tolerated, beyond};
    return each.factor > 0 ? AlarmLimits{unknown, beyond} : AlarmLimits{beyond, unknown};
  }
  if (indicator.name.starts_with("coil_resistance"))
    return {unknown, indicator.baseline * (1 + copper_per_K * hottest_over_calibration_K)};
  return {unknown, unknown};
}

namespace {

void add_magnitudes(const DirectionReference& reference, const DirectionState& side, bool a,
                    std::vector<Indicator>& out) {
  constexpr double least_windows = 2;
  const Isolation found = isolation_of(reference, side);
  const Evidence evidence = evidence_of(reference, side);
  for (const InItsUnit& each : in_its_unit) {
    const std::size_t k = index(each.magnitude);
    const bool known = evidence.information[k * magnitudes + k] > 0;
    const double unit = each.factor * usual_fault[k];
    const bool is_raised = decided(side, found) && found.likeliest[static_cast<std::size_t>(each.fault)];
    const IndicatorState state = !known                         ? IndicatorState::unknown
                                 : is_raised                    ? IndicatorState::raised
                                 : side.windows < least_windows ? IndicatorState::learning
                                                                : IndicatorState::good;
    out.push_back({each.names.of(a), known ? each.at_zero + unit * found.value[k] : unknown, each.unit,
                   known ? 2 * std::abs(unit) * found.deviation[k] : unknown,
                   each.at_zero + unit * reference.baseline.centre[k], state, trend_of(reference, side, each),
                   std::abs(unit) * reference.baseline.spread[k]});
  }
}

void add_contacts(const DirectionState& side, bool a, std::vector<Indicator>& out) {
  const auto put = [&](const Names& names, const Weighted& mean, std::string_view unit, double baseline) {
    const bool known = mean.weight > 0;
    out.push_back({names.of(a), known ? mean.value : unknown, unit, known ? 2 * deviation(mean) : unknown,
                   known ? baseline : unknown, known ? IndicatorState::good : IndicatorState::unknown});
  };
  constexpr std::array<Names, friction_regions> regions{{{"friction_ratio_closed", "friction_ratio_closed_a"},
                                                         {"friction_ratio_middle", "friction_ratio_middle_a"},
                                                         {"friction_ratio_open", "friction_ratio_open_a"}}};
  const ContactReading& mean = side.contacts.mean;
  for (std::size_t k = 0; k < friction_regions; ++k) put(regions[k], mean.friction_ratio[k], "1", 1);
  put({"breakaway_force", "breakaway_force_a"}, mean.breakaway_N, "N", mean.breakaway_expected_N);
  put({"stick_slip_share", "stick_slip_share_a"}, mean.stick_share, "1", unknown);
  put({"hysteresis_width", "hysteresis_width_a"}, mean.width_A, "A", mean.width_expected_A);
}

void add_winding(const DirectionReference& reference, const DirectionState& side, bool a, std::vector<Indicator>& out) {
  const WindingState& winding = side.winding;
  const bool warm = winding.windows > 0;
  const double calibrated_Ohm = reference.valve->actuator.coil_resistance.resistance_Ohm;
  const double base_Ohm = reference.baseline.resistance_Ohm > 0 ? reference.baseline.resistance_Ohm : calibrated_Ohm;
  const IndicatorState state = !warm            ? IndicatorState::unknown
                               : side.resistive ? IndicatorState::raised
                                                : IndicatorState::good;
  constexpr Names resistance{"coil_resistance", "coil_resistance_a"};
  constexpr Names warmer{"winding_warmer_than_reference", "winding_warmer_than_reference_a"};
  out.push_back({resistance.of(a), warm ? winding.resistance_Ohm : unknown, "Ohm",
                 warm ? 2 * resistance_deviation_Ohm(winding) : unknown, base_Ohm, state});
  const bool known = warm && base_Ohm > 0;
  out.push_back({warmer.of(a), known ? (winding.resistance_Ohm / base_Ohm - 1) / copper_per_K : unknown, "K",
                 known ? 2 * resistance_deviation_Ohm(winding) / base_Ohm / copper_per_K : unknown, 0,
                 warm ? IndicatorState::good : IndicatorState::unknown});
}

/// Of a baseline [m].
double usual_zero_m(const DirectionReference& reference) {
  constexpr std::size_t zero = index(Magnitude::position_zero);
  return reference.baseline.centre[zero] * usual_fault[zero];
}

void add_closed(const DirectionReference& reference, const DirectionState& side, std::vector<Indicator>& out) {
  const bool rested = side.learnt.rest.weight > 0;
  out.push_back({"closed_position", rested ? side.learnt.rest.mean_m : unknown, "m",
                 rested ? 2 * rest_deviation_m : unknown, usual_zero_m(reference),
                 rested ? IndicatorState::good : IndicatorState::unknown});
}

}  // namespace

void add_centre(const std::array<DirectionReference, 2>& reference, const std::array<DirectionState, 2>& sides,
                const CentreRest& rest, std::vector<Indicator>& out) {
  const bool known = rest.pairs > 0;
  bool is_raised = false;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Isolation found = isolation_of(reference[k], sides[k]);
    is_raised =
        is_raised || (decided(sides[k], found) && found.likeliest[static_cast<std::size_t>(Fault::position_sensor)]);
  }
  const double readings = std::fmin(std::fmax(rest.pairs, 1), independent_windows);
  const IndicatorState state = !known            ? IndicatorState::unknown
                               : is_raised       ? IndicatorState::raised
                               : rest.pairs <= 1 ? IndicatorState::learning
                                                 : IndicatorState::good;
  out.push_back({"centre_position", known ? centre_zero_m(rest) : unknown, "m",
                 known ? 2 * centre_deviation_m(rest) / std::sqrt(readings) : unknown, usual_zero_m(reference[0]),
                 state});
}

void add_direction(const DirectionReference& reference, const DirectionState& side, bool a,
                   std::vector<Indicator>& out) {
  add_magnitudes(reference, side, a, out);
  add_winding(reference, side, a, out);
  if (!reference.whole) add_closed(reference, side, out);
  add_contacts(side, a, out);
}

void add_command_response(const CommandResponse& response, std::vector<Indicator>& out) {
  const bool known = response.steps > 0;
  const IndicatorState state = known ? IndicatorState::good : IndicatorState::unknown;
  const auto put = [&](std::string_view name, double mean, double square, std::string_view unit) {
    out.push_back({name, known ? mean : unknown, unit,
                   known ? 2 * deviation_of_mean(mean, square, response.steps) : unknown, unknown, state});
  };
  put("response_time", response.response_s, response.response2_s2, "s");
  put("overshoot", response.overshoot, response.overshoot2, "1");
}

void add_dither_health(const DitherHealth& dither, double amplitude_A, double frequency_Hz,
                       std::vector<Indicator>& out) {
  const bool known = dither.dithered_s >= least_dithered_s;
  const IndicatorState state = known ? IndicatorState::good : IndicatorState::unknown;
  // Samples seldom meet the peaks, and the period is known in whole samples.
  constexpr double peak_share = 0.2, period_share = 0.1;
  const auto put = [&](std::string_view name, double value, std::string_view unit, double share, double baseline) {
    out.push_back({name, known ? value : unknown, unit, known ? share * value : unknown,
                   baseline > 0 ? baseline : unknown, state});
  };
  put("dither_amplitude", dither.amplitude_A, "A", peak_share, amplitude_A);
  put("dither_frequency", dither.frequency_Hz, "Hz", period_share, frequency_Hz);
  put("dither_frees", dither.free_share, "1", 0, 0);
}

void add_usage(const Usage& usage, double windows, std::vector<Indicator>& out) {
  const auto counted = [&](std::string_view name, double value, std::string_view unit) {
    out.push_back({name, value, unit, 0, unknown, IndicatorState::counts});
  };
  counted("judged_windows", windows, "1");
  counted("watched_time", usage.watched_s, "s");
  counted("driven_time", usage.driven_s, "s");
  counted("strokes", static_cast<double>(usage.strokes), "1");
  counted("reversals", static_cast<double>(usage.reversals), "1");
  counted("distance", usage.distance_m, "m");
  counted("oil_volume", usage.volume_m3, "m3");
  counted("hydraulic_energy", usage.energy_J, "J");
}

}  // namespace spoolflow::monitor
