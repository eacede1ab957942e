#include "spoolflow/consistency/relation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "spoolflow/consistency/block_means.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::consistency {
namespace {

using recording::Channel;
using recording::Recording;

/// Limits lie two to five times above what valves A and W and the rig's valves have.
constexpr double force_residual_share = 0.06;     ///< of the range of forces
constexpr double flow_residual_share = 0.04;      ///< of the largest flow
constexpr double usual_jet_momentum = 0.35;       ///< nearly cos 69 deg; notches and compensated spools differ
constexpr double jet_momentum_factor = 2.0;       ///< either way
constexpr double set_pressure_factor = 1.4;       ///< either way
constexpr double rated_flow_factor = 2.5;         ///< either way
constexpr double resistance_factor = 1.45;        ///< a coil of copper is so much higher 115 K warmer
constexpr double balance_share = 0.09;            ///< of the range of axial forces
constexpr double run_flow_factor = 1.13;          ///< either way
constexpr double run_flow_residual_share = 0.05;  ///< of the largest flow
constexpr double outside_share = 0.1;             ///< of positions beyond the stroke
constexpr double least_opening = 0.1;             ///< share of the stroke from which forces and flow tell
constexpr double least_blocks = 50;
constexpr double impossible = 10;

double factor_over(double value, double usual, double factor) {
  return value > 0 ? std::abs(std::log(value / usual)) / std::log(factor) : 20.0;
}

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::string file_of(const Recording& recording) {
  return recording.file.filename().string();
}

/// Positions lie within the stroke, bench strokes go over half of it at least, an operating run opens the valve.
void add_travel(std::vector<Deviation>& to, const Recording& means, double stroke_m, bool strokes) {
  constexpr double beyond = 0.15;
  const std::vector<double>& position_m = means.column(Channel::position);
  double outside = 0, count = 0, lowest = 1e300, highest = -1e300;
  for (const double position : position_m) {
    if (!std::isfinite(position)) continue;
    ++count;
    outside += position < -beyond * stroke_m || position > (1 + beyond) * stroke_m;
    lowest = std::min(lowest, position);
    highest = std::max(highest, position);
  }
  if (count == 0) return;
  const bool too_short = strokes && highest - lowest < 0.5 * stroke_m;
  to.push_back({.of = "travel",
                .shown = fmt::format("{:.3g} to {:.3g} mm", units::mm_from_m(lowest), units::mm_from_m(highest)),
                .over_limit = too_short ? impossible : outside / count / outside_share,
                .file = file_of(means)});
  if (strokes) return;
  constexpr double doubtful = 1.6;  // a valve may well stay closed
  to.push_back({.of = largest_opening,
                .shown = fmt::format("{:.3g} mm", units::mm_from_m(highest)),
                .over_limit = highest < least_opening * stroke_m ? doubtful : 0,
                .file = file_of(means)});
}

/// Without pressure and flow: what the solenoid holds is no less than the springs and no more than springs and the
/// largest flow force, but for friction.
void add_force_bounds(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                      const Recording& run) {
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& current_A = run.column(Channel::current);
  double square = 0, count = 0;
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double x = position_m[k];
    if (!(x > least_opening * hydraulics.stroke_m) || !std::isfinite(current_A[k])) continue;
    const double net_N = magnetics.at(current_A[k], x) - hydraulics.spring_at(x);
    const double most_N = hydraulics.force_per_Pa_at(x) * hydraulics.highest_pressure_Pa;
    const double beyond_N =
        std::max({0.0, -net_N - 2 * hydraulics.friction_N, net_N - most_N - 2 * hydraulics.friction_N});
    square += beyond_N * beyond_N;
    ++count;
  }
  if (count < least_blocks) return;
  const double beyond_N = std::sqrt(square / count);
  to.push_back({.of = "force that neither springs, flow nor friction explain",
                .shown = fmt::format("{:.2g} N RMS", beyond_N),
                .over_limit = beyond_N / (balance_share * hydraulics.force_range_N),
                .file = file_of(run),
                .blocks = count});
}

/// Magnetic force against spring, flow force and friction, at the measured pressure difference or that of the flow.
void add_balance(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                 const Recording& run) {
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& current_A = run.column(Channel::current);
  const std::vector<double>& pressure_Pa = run.column(Channel::pressure_difference);
  const std::vector<double>& flow = run.column(Channel::flow);
  const std::vector<double> velocity = velocities(run);
  constexpr double least_share = 0.02;
  const double least_conductance = least_share * std::ranges::max(hydraulics.conductance);
  struct Block {
    double error_N, direction;
  };
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double x = position_m[k];
    const double conductance = hydraulics.conductance_at(x);
    if (!(x > least_opening * hydraulics.stroke_m) || conductance < least_conductance) continue;
    const double pressure = pressure_Pa.empty() ? squared(std::max(flow[k], 0.0) / conductance) : pressure_Pa[k];
    const double error_N =
        magnetics.at(current_A[k], x) - hydraulics.spring_at(x) - hydraulics.force_per_Pa_at(x) * pressure;
    if (std::isfinite(error_N)) blocks.push_back({error_N, velocity[k] > 0 ? 1.0 : -1.0});
  }
  const auto count = static_cast<double>(blocks.size());
  if (count < least_blocks) return;
  double friction_N = 0, square = 0;
  for (const Block& block : blocks) friction_N += block.error_N * block.direction / count;
  for (const Block& block : blocks) square += squared(block.error_N - friction_N * block.direction) / count;
  to.push_back({.of = "balance of forces in operation",
                .shown = fmt::format("{:.2g} N RMS", std::sqrt(square)),
                .over_limit = std::sqrt(square) / (balance_share * hydraulics.force_range_N),
                .file = file_of(run),
                .blocks = count});
}

struct FlowFit {
  double ratio;     ///< reference over expected flow; NaN where too little is known
  double residual;  ///< RMS of their difference [m3/s]
};

FlowFit compared(std::span<const double> reference, std::span<const double> expected) {
  double product = 0, expected2 = 0, residual2 = 0, count = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    if (!std::isfinite(reference[k] + expected[k])) continue;
    product += reference[k] * expected[k];
    expected2 += squared(expected[k]);
    residual2 += squared(reference[k] - expected[k]);
    ++count;
  }
  if (count < least_blocks || !(expected2 > 0)) return {std::nan(""), 0};
  return {product / expected2, std::sqrt(residual2 / count)};
}

/// The reference against what edge and pressure difference make, shown as late as the meter is where that matters.
void add_flow_deviations(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const Recording& run) {
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& pressure_Pa = run.column(Channel::pressure_difference);
  const std::vector<double>& reference = run.column(Channel::flow);
  std::vector<double> expected(reference.size());
  double largest = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double conductance = std::max(hydraulics.conductance_at(std::max(position_m[k], 0.0)), 0.0);
    expected[k] = conductance * std::copysign(std::sqrt(std::abs(pressure_Pa[k])), pressure_Pa[k]);
    if (std::isfinite(expected[k])) largest = std::max(largest, std::abs(expected[k]));
  }
  FlowFit found = compared(reference, expected);
  if (!std::isfinite(found.ratio)) return;
  if (found.ratio > 0 && found.residual > run_flow_residual_share * largest) {
    std::vector<double> alike = expected;
    for (double& value : alike) value *= found.ratio;
    const std::vector<double>& time_s = run.column(Channel::time);
    numerics::apply_lag<double>(time_s, expected, numerics::find_meter_lag(time_s, alike, reference));
    found = compared(reference, expected);
  }
  to.push_back({.of = reference_ratio,
                .shown = fmt::format("{:.3g}", found.ratio),
                .over_limit = factor_over(found.ratio, 1, run_flow_factor),
                .file = file_of(run),
                .ratio = found.ratio});
  to.push_back({.of = "reference flow less that of edge and pressure difference",
                .shown = fmt::format("{:.2g} L/min RMS", units::L_per_min_from_m3_per_s(found.residual)),
                .over_limit = found.residual / (run_flow_residual_share * largest),
                .file = file_of(run)});
}

}  // namespace

void add_hydraulic_deviations(std::vector<Deviation>& to, const HydraulicCurves& curves, const Recording* spring,
                              const std::vector<const Recording*>& maps) {
  if (spring != nullptr) add_travel(to, *spring, curves.stroke_m, true);
  for (const Recording* map : maps) add_travel(to, *map, curves.stroke_m, true);
  const double rate = (curves.spring_N.back() - curves.spring_N.front()) / curves.stroke_m;
  to.push_back({.of = "the springs' rate",
                .shown = fmt::format("{:.3g} N/mm", rate * units::m_from_mm(1)),
                .over_limit = rate > 0 && curves.spring_N.back() > 0 ? 0 : impossible});
  to.push_back({.of = "what axial forces leave of one spring and one flow force",
                .shown = fmt::format("{:.2g} N RMS", curves.force_residual_N),
                .over_limit = curves.force_residual_N / (force_residual_share * curves.force_range_N)});
  if (!(curves.largest_flow_m3_per_s > 0)) return;
  to.push_back({.of = "what flows leave of one curve over the root of the pressure difference",
                .shown = fmt::format("{:.2g} L/min RMS", units::L_per_min_from_m3_per_s(curves.flow_residual_m3_per_s)),
                .over_limit = curves.flow_residual_m3_per_s / (flow_residual_share * curves.largest_flow_m3_per_s)});
  const bool opens = curves.conductance.back() > curves.conductance.front() &&
                     std::accumulate(curves.conductance.begin(), curves.conductance.end(), 0.0) > 0;
  to.push_back(
      {.of = "flow over opening", .shown = opens ? "rising" : "not rising", .over_limit = opens ? 0 : impossible});
  to.push_back({.of = "flow force over the jet's momentum",
                .shown = fmt::format("{:.2g}", curves.jet_momentum_share),
                .over_limit = factor_over(curves.jet_momentum_share, usual_jet_momentum, jet_momentum_factor)});
  for (const Recording* map : maps) {
    std::vector<double> ratios;
    const std::vector<double>& set = map->column(Channel::pressure_difference_set);
    const std::vector<double>& measured = map->column(Channel::pressure_difference);
    for (std::size_t k = 0; k < set.size(); ++k) {
      if (set[k] > units::Pa_from_bar(1) && std::isfinite(measured[k])) ratios.push_back(measured[k] / set[k]);
    }
    if (ratios.empty()) continue;
    const double ratio = median_of(ratios);
    to.push_back({.of = "measured over set pressure difference",
                  .shown = fmt::format("{:.2g}", ratio),
                  .over_limit = factor_over(ratio, 1, set_pressure_factor),
                  .file = file_of(*map)});
  }
}

void add_magnetic_deviations(std::vector<Deviation>& to, const MagneticCurves& curves, const Recording& map) {
  add_travel(to, map, curves.stroke_m, true);
  to.push_back({.of = "magnetic force over current",
                .shown = curves.mean_N > 0 ? (curves.rises ? "rising" : "falling") : "negative",
                .over_limit = curves.mean_N > 0 && curves.rises ? 0 : impossible,
                .file = file_of(map)});
  to.push_back({.of = "what magnetic forces leave of one map",
                .shown = fmt::format("{:.2g} N RMS", curves.residual_N),
                .over_limit = curves.residual_N / (force_residual_share * curves.range_N),
                .file = file_of(map)});
}

void add_run_deviations(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                        const Recording& run) {
  add_travel(to, run, hydraulics.stroke_m, false);
  const bool with_pressure = run.has(Channel::pressure_difference), with_flow = run.has(Channel::flow);
  if (run.has(Channel::current)) {
    if (with_pressure || with_flow) {
      add_balance(to, hydraulics, magnetics, run);
    } else {
      add_force_bounds(to, hydraulics, magnetics, run);
    }
  }
  if (with_pressure && with_flow) add_flow_deviations(to, hydraulics, run);
}

void add_rated_flow_deviation(std::vector<Deviation>& to, const HydraulicCurves& curves, double rated_flow_m3_per_s) {
  if (!(curves.largest_flow_m3_per_s > 0)) return;
  const double ratio = curves.largest_flow_m3_per_s / rated_flow_m3_per_s;
  to.push_back({.of = "largest recorded over rated flow",
                .shown = fmt::format("{:.2g}", ratio),
                .over_limit = factor_over(ratio, 1, rated_flow_factor)});
}

double coil_resistance(const Recording& means) {
  const std::vector<double>& current_A = means.column(Channel::current);
  const std::vector<double>& voltage_V = means.column(Channel::voltage);
  if (current_A.size() < 3 || voltage_V.empty()) return std::nan("");
  double largest = 0;
  for (const double current : current_A) largest = std::max(largest, std::isfinite(current) ? std::abs(current) : 0);
  constexpr double least_share = 0.3, still_share = 0.01;
  std::vector<double> out;
  for (std::size_t k = 1; k + 1 < current_A.size(); ++k) {
    const bool still = std::abs(current_A[k + 1] - current_A[k - 1]) < still_share * largest;
    if (still && std::abs(current_A[k]) > least_share * largest && std::isfinite(voltage_V[k]))
      out.push_back(voltage_V[k] / current_A[k]);
  }
  constexpr std::size_t least_blocks = 20;
  return out.size() < least_blocks ? std::nan("") : median_of(out);
}

void add_resistance_deviation(std::vector<Deviation>& to, const std::vector<const Recording*>& recordings,
                              double known_Ohm) {
  double lowest = known_Ohm > 0 ? known_Ohm : 1e300, highest = known_Ohm > 0 ? known_Ohm : -1e300;
  bool told = false;
  for (const Recording* recording : recordings) {
    const double resistance = coil_resistance(*recording);
    if (!std::isfinite(resistance)) continue;
    lowest = std::min(lowest, resistance);
    highest = std::max(highest, resistance);
    told = true;
  }
  if (!told) return;
  to.push_back({.of = known_Ohm > 0 ? "coil resistance against the model's, larger over smaller,"
                                    : "coil resistance, largest over smallest of the recordings,",
                .shown = fmt::format("{:.3g}", highest / lowest),
                .over_limit = lowest > 0 ? std::log(highest / lowest) / std::log(resistance_factor) : 20.0});
}

Change telling_change(const std::vector<Deviation>& before, const std::vector<Deviation>& after) {
  Change out{&before.front(), &after.front()};
  double most = -1;
  for (const Deviation& old : before) {
    const auto same = std::ranges::find_if(
        after, [&](const Deviation& deviation) { return deviation.of == old.of && deviation.file == old.file; });
    if (same == after.end()) continue;
    const double gain = std::min(old.over_limit, 1e3) - std::min(same->over_limit, 1e3);
    if (gain > most) {
      most = gain;
      out = {&old, &*same};
    }
  }
  return out;
}

std::string told(const Change& change) {
  return fmt::format("{} goes from {} to {}", change.before->of, change.before->shown, change.after->shown);
}

bool judges_as_much(const std::vector<Deviation>& after, const std::vector<Deviation>& before) {
  return std::ranges::all_of(before, [&](const Deviation& old) {
    const auto same = std::ranges::find_if(
        after, [&](const Deviation& deviation) { return deviation.of == old.of && deviation.file == old.file; });
    return same != after.end() && 2 * same->blocks >= old.blocks;
  });
}

double badness(const std::vector<Deviation>& deviations) {
  double out = 0;
  for (const Deviation& deviation : deviations) {
    const double over = std::isfinite(deviation.over_limit) ? std::min(deviation.over_limit, 1e3) : 1e3;
    out += std::log1p(over * over * over * over);
  }
  return out;
}

}  // namespace spoolflow::consistency
