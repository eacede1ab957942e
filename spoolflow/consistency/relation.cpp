#include "spoolflow/consistency/relation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/consistency/block_means.hpp"
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
constexpr double resistance_factor = 1.35;        ///< a coil of copper is so much higher 90 K warmer
constexpr double balance_share = 0.09;            ///< of the range of axial forces
constexpr double run_flow_factor = 1.13;          ///< either way
constexpr double run_flow_residual_share = 0.05;  ///< of the largest flow
constexpr double outside_share = 0.1;             ///< of positions beyond the stroke
constexpr double least_opening = 0.1;             ///< share of the stroke from which forces and flow tell
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

/// Positions lie within the stroke, bench strokes go over half of it at least, and an operating run opens the valve.
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
  const bool too_short = strokes ? highest - lowest < 0.5 * stroke_m : highest < least_opening * stroke_m;
  to.push_back({.of = "travel",
                .shown = fmt::format("{:.3g} to {:.3g} mm", units::mm_from_m(lowest), units::mm_from_m(highest)),
                .over_limit = too_short ? impossible : outside / count / outside_share,
                .file = file_of(means)});
}

}  // namespace

void add_hydraulic_deviations(std::vector<Deviation>& to, const HydraulicCurves& curves, const Recording* spring,
                              const std::vector<const Recording*>& maps) {
  if (spring != nullptr) add_travel(to, *spring, curves.stroke_m, true);
  for (const Recording* map : maps) add_travel(to, *map, curves.stroke_m, true);
  const double rate = (curves.spring_N.tail(1)[0] - curves.spring_N[0]) / curves.stroke_m;
  to.push_back({.of = "the springs' rate",
                .shown = fmt::format("{:.3g} N/mm", rate * units::m_from_mm(1)),
                .over_limit = rate > 0 && curves.spring_N.tail(1)[0] > 0 ? 0 : impossible});
  to.push_back({.of = "what axial forces leave of one spring and one flow force",
                .shown = fmt::format("{:.2g} N RMS", curves.force_residual_N),
                .over_limit = curves.force_residual_N / (force_residual_share * curves.force_range_N)});
  if (!(curves.largest_flow_m3_per_s > 0)) return;
  to.push_back({.of = "what flows leave of one curve over the root of the pressure difference",
                .shown = fmt::format("{:.2g} L/min RMS", units::L_per_min_from_m3_per_s(curves.flow_residual_m3_per_s)),
                .over_limit = curves.flow_residual_m3_per_s / (flow_residual_share * curves.largest_flow_m3_per_s)});
  const bool opens = curves.conductance.tail(1)[0] > curves.conductance[0] && curves.conductance.mean() > 0;
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
  const double stroke_m = hydraulics.stroke_m;
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& current_A = run.column(Channel::current);
  const std::vector<double>& pressure_Pa = run.column(Channel::pressure_difference);
  const std::vector<double>& flow = run.column(Channel::flow);
  const std::vector<double> velocity = velocities(run);
  add_travel(to, run, stroke_m, false);
  if (current_A.empty() || (pressure_Pa.empty() && flow.empty())) return;
  const double least_conductance = 0.02 * hydraulics.conductance.maxCoeff();
  struct Block {
    double error_N, direction, flow, expected;
  };
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double x = position_m[k];
    const double conductance = hydraulics.conductance_at(x);
    if (!(x > least_opening * stroke_m) || conductance < least_conductance) continue;
    const double pressure = pressure_Pa.empty()
                                ? std::max(flow[k], 0.0) * std::max(flow[k], 0.0) / (conductance * conductance)
                                : pressure_Pa[k];
    const double error_N =
        magnetics.at(current_A[k], x) - hydraulics.spring_at(x) - hydraulics.force_per_Pa_at(x) * pressure;
    if (!std::isfinite(error_N)) continue;
    blocks.push_back({error_N, velocity[k] > 0 ? 1.0 : -1.0, flow.empty() ? std::nan("") : flow[k],
                      conductance * std::sqrt(std::abs(pressure))});
  }
  constexpr std::size_t least_blocks = 50;
  if (blocks.size() < least_blocks) return;
  const double count = static_cast<double>(blocks.size());
  double friction_N = 0, square = 0;
  for (const Block& block : blocks) friction_N += block.error_N * block.direction / count;
  for (const Block& block : blocks) {
    const double left_N = block.error_N - friction_N * block.direction;
    square += left_N * left_N / count;
  }
  to.push_back({.of = "balance of forces in operation",
                .shown = fmt::format("{:.2g} N RMS", std::sqrt(square)),
                .over_limit = std::sqrt(square) / (balance_share * hydraulics.force_range_N),
                .file = file_of(run)});
  if (pressure_Pa.empty() || flow.empty()) return;
  double product = 0, expected2 = 0, largest = 0, numbers = 0;
  for (const Block& block : blocks) {
    if (!std::isfinite(block.flow)) continue;
    product += block.flow * block.expected;
    expected2 += block.expected * block.expected;
    largest = std::max(largest, block.expected);
    ++numbers;
  }
  if (numbers < static_cast<double>(least_blocks)) return;
  const double ratio = product / expected2;
  double residual2 = 0;
  for (const Block& block : blocks) {
    if (std::isfinite(block.flow)) residual2 += (block.flow - block.expected) * (block.flow - block.expected) / numbers;
  }
  to.push_back({.of = "reference flow over that of edge and pressure difference",
                .shown = fmt::format("{:.3g}", ratio),
                .over_limit = factor_over(ratio, 1, run_flow_factor),
                .file = file_of(run)});
  to.push_back({.of = "reference flow less that of edge and pressure difference",
                .shown = fmt::format("{:.2g} L/min RMS", units::L_per_min_from_m3_per_s(std::sqrt(residual2))),
                .over_limit = std::sqrt(residual2) / (run_flow_residual_share * largest),
                .file = file_of(run)});
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

void add_resistance_deviation(std::vector<Deviation>& to, const std::vector<const Recording*>& recordings) {
  double lowest = 1e300, highest = -1e300;
  for (const Recording* recording : recordings) {
    const double resistance = coil_resistance(*recording);
    if (!std::isfinite(resistance)) continue;
    lowest = std::min(lowest, resistance);
    highest = std::max(highest, resistance);
  }
  if (highest < lowest) return;
  to.push_back({.of = "coil resistance, largest over smallest of the recordings,",
                .shown = fmt::format("{:.3g}", highest / lowest),
                .over_limit = lowest > 0 ? std::log(highest / lowest) / std::log(resistance_factor) : 20.0});
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
