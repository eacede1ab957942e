#include "spoolflow/plausibility/bench_relations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "spoolflow/numerics/largest_magnitude.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// Energy: what moving the armature at a held current does to the coil's voltage follows from the force, as the flux
/// linkage grows by dF/di over the position (dF/di = d flux / dx at one current).
void add_induced_voltage(std::vector<Deviation>& to, const MagneticCurves& curves, const Recording& map) {
  if (!map.has(Channel::voltage)) return;
  constexpr int levels = 25;
  constexpr double step_share = 0.1, still_share = 0.02, usual_ratio = 0.93, factor = 1.6, most_error = 0.15;
  constexpr std::size_t least_in_level = 20;
  const std::vector<double>& current_A = map.column(Channel::current);
  const std::vector<double>& position_m = map.column(Channel::position);
  const std::vector<double>& voltage_V = map.column(Channel::voltage);
  const std::vector<double> velocity = velocities(map);
  struct Pair {
    double expected_V, measured_V;
  };
  std::vector<std::vector<Pair>> held(levels + 1);
  const double largest_A = curves.largest_current_A;
  for (std::size_t k = 1; k + 1 < current_A.size(); ++k) {
    const double i = current_A[k], x = position_m[k];
    if (!(std::abs(current_A[k + 1] - current_A[k - 1]) < 2 * still_share * largest_A) || !(i >= 0)) continue;
    const double above = std::min(i + step_share * largest_A, largest_A),
                 below = std::max(i - step_share * largest_A, 0.0);
    const double force_per_A = (curves.at(above, x) - curves.at(below, x)) / (above - below);
    const Pair pair{force_per_A * velocity[k], voltage_V[k]};
    if (std::isfinite(pair.expected_V + pair.measured_V))
      held[static_cast<std::size_t>(std::lround(levels * i / largest_A))].push_back(pair);
  }
  double product = 0, expected2 = 0, measured2 = 0, count = 0;
  for (const std::vector<Pair>& level : held) {
    if (level.size() < least_in_level) continue;
    Pair mean{0, 0};
    for (const Pair& pair : level) {
      mean.expected_V += pair.expected_V / static_cast<double>(level.size());
      mean.measured_V += pair.measured_V / static_cast<double>(level.size());
    }
    for (const Pair& pair : level) {
      product += (pair.expected_V - mean.expected_V) * (pair.measured_V - mean.measured_V);
      expected2 += squared(pair.expected_V - mean.expected_V);
      measured2 += squared(pair.measured_V - mean.measured_V);
      ++count;
    }
  }
  if (count < least_blocks || !(expected2 > 0)) return;
  const double ratio = product / expected2;
  const double error = std::sqrt(std::max(measured2 / expected2 - squared(ratio), 0.0) / count);
  if (error > most_error * std::max(1.0, std::abs(ratio))) return;  // drowned in the voltage's noise
  to.push_back({.of = "voltage that the moving armature induces, over what the force makes it,",
                .shown = fmt::format("{:.2g}", ratio),
                .over_limit = factor_over(ratio, usual_ratio, factor),
                .file = file_of(map)});
}

/// A map's flow or flow force, as the logarithm over that of all.
struct MapPlace {
  double temperature_K, log_ratio;
};
struct Slopes {
  double least_per_K, most_per_K;
};

/// How far map `k` stands from the lines of usual slope on which the others are; NaN where they are on none.
double apart(const std::vector<MapPlace>& maps, std::size_t k, const Slopes& slopes) {
  constexpr int tried = 31;
  double out = std::nan("");
  for (int step = 0; step < tried; ++step) {
    const double slope = slopes.least_per_K + (slopes.most_per_K - slopes.least_per_K) * step / (tried - 1);
    const auto level = [&](const MapPlace& map) {
      return map.log_ratio - slope * (map.temperature_K - maps[k].temperature_K);
    };
    double least = impossible, most = -impossible;
    for (std::size_t other = 0; other < maps.size(); ++other) {
      if (other == k) continue;
      least = std::min(least, level(maps[other]));
      most = std::max(most, level(maps[other]));
    }
    if (most - least > 2 * maps_alike) continue;
    const double off = maps[k].log_ratio - (least + most) / 2;
    if (!(std::abs(off) >= std::abs(out))) out = off;
  }
  return out;
}

/// The map that least makes all agree, if it stood where the others say.
void add_apart(std::vector<Deviation>& to, const char* of, const std::vector<MapPlace>& maps, const Slopes& slopes,
               const std::vector<const Recording*>& recordings) {
  std::vector<double> off;
  for (const MapPlace& map : maps) {
    if (!std::isfinite(map.temperature_K + map.log_ratio)) return;
  }
  for (std::size_t k = 0; k < maps.size(); ++k) off.push_back(apart(maps, k, slopes));
  std::size_t odd = 0;
  for (std::size_t k = 1; k < off.size(); ++k) {
    if (!(std::abs(off[odd]) <= std::abs(off[k])) && !std::isnan(off[k])) odd = k;
  }
  for (std::size_t k = 0; k < off.size(); ++k) {
    to.push_back({.of = fmt::format("{} over what the other axial-force maps have at the same opening, pressure "
                                    "difference and oil temperature",
                                    of),
                  .shown = fmt::format("{:.3g}", std::exp(off[k])),
                  .over_limit = k == odd && !std::isnan(off[k]) ? std::abs(off[k]) / map_share : 0,
                  .file = file_of(*recordings[k]),
                  .blocks = std::isnan(off[k]) ? 0.0 : 1.0});
  }
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
    const double ratio = numerics::median(std::move(ratios));
    to.push_back({.of = "measured over set pressure difference",
                  .shown = fmt::format("{:.2g}", ratio),
                  .over_limit = factor_over(ratio, 1, set_pressure_factor),
                  .file = file_of(*map)});
  }
}

void add_map_deviations(std::vector<Deviation>& to, const HydraulicCurves& curves,
                        const std::vector<const Recording*>& maps) {
  if (maps.size() < 2) return;
  std::vector<MapPlace> flow, flow_force;
  for (const Recording* map : maps) {
    const MapRatios ratios = map_ratios(curves, *map);
    const double temperature_K = mean_of_numbers(map->column(Channel::oil_temperature));
    flow.push_back({temperature_K, std::log(ratios.flow)});
    flow_force.push_back({temperature_K, std::log(ratios.flow_force)});
  }
  add_apart(to, "flow", flow, {least_flow_per_K, most_flow_per_K}, maps);
  add_apart(to, "flow force", flow_force, {least_flow_force_per_K, most_flow_force_per_K}, maps);
}

void add_magnetic_deviations(std::vector<Deviation>& to, const MagneticCurves& curves, const Recording& map) {
  add_travel(to, map, curves.stroke_m, true, outside_share_of_carriage);
  to.push_back({.of = "magnetic force over current",
                .shown = curves.mean_N > 0 ? (curves.rises ? "rising" : "falling") : "negative",
                .over_limit = curves.mean_N > 0 && curves.rises ? 0 : impossible,
                .file = file_of(map)});
  to.push_back({.of = "what magnetic forces leave of one map",
                .shown = fmt::format("{:.2g} N RMS", curves.residual_N),
                .over_limit = curves.residual_N / (force_residual_share * curves.range_N),
                .file = file_of(map)});
  add_induced_voltage(to, curves, map);
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
  const double largest = numerics::largest_magnitude(current_A);
  constexpr double least_share = 0.3, still_share = 0.01;
  std::vector<double> out;
  for (std::size_t k = 1; k + 1 < current_A.size(); ++k) {
    const bool still = std::abs(current_A[k + 1] - current_A[k - 1]) < still_share * largest;
    if (still && std::abs(current_A[k]) > least_share * largest && std::isfinite(voltage_V[k]))
      out.push_back(voltage_V[k] / current_A[k]);
  }
  constexpr std::size_t fewest = 20;
  return out.size() < fewest ? std::nan("") : numerics::median(std::move(out));
}

void add_resistance_deviation(std::vector<Deviation>& to, const std::vector<const Recording*>& recordings,
                              double known_Ohm) {
  double lowest = known_Ohm > 0 ? known_Ohm : 1e300, highest = known_Ohm > 0 ? known_Ohm : -1e300;
  bool measured = false;
  for (const Recording* recording : recordings) {
    const double resistance = coil_resistance(*recording);
    if (!std::isfinite(resistance)) continue;
    lowest = std::min(lowest, resistance);
    highest = std::max(highest, resistance);
    measured = true;
  }
  if (!measured) return;
  to.push_back({.of = known_Ohm > 0 ? "coil resistance against the model's, larger over smaller,"
                                    : "coil resistance, largest over smallest of the recordings,",
                .shown = fmt::format("{:.3g}", highest / lowest),
                .over_limit = lowest > 0 ? std::log(highest / lowest) /
                                               std::log(known_Ohm > 0 ? run_resistance_factor : resistance_factor)
                                         : 20.0});
}

}  // namespace spoolflow::plausibility
