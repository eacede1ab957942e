#include "spoolflow/plausibility/valve_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/sparse_fit.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

constexpr int position_knots = 8;
constexpr int map_knots = 6;
constexpr double least_pressure_Pa = 2e4;
/// Slower than this share of the fast strokes the direction of friction is not known.
constexpr double least_speed_share = 0.25;

/// Least speed at which the spool surely moves [m/s].
double moving_speed(std::vector<double> speeds) {
  if (speeds.empty()) return 0;
  for (double& speed : speeds) speed = std::abs(speed);
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() * 9 / 10);
  std::ranges::nth_element(speeds, place);
  return least_speed_share * *place;
}

/// Spring, flow force and friction of one block.
std::array<Weight, 5> force_row(double position_m, double pressure_bar, double direction, double stroke_m) {
  const auto [lower, upper] = between_knots(position_m, stroke_m, position_knots);
  return {lower, upper, Weight{position_knots + lower.unknown, lower.factor * pressure_bar},
          Weight{position_knots + upper.unknown, upper.factor * pressure_bar}, Weight{2 * position_knots, direction}};
}

struct ForceBlock {
  std::array<Weight, 5> row;
  double force_N;
};

std::vector<ForceBlock> force_blocks(const Recording& means, bool pressurised, double stroke_m) {
  constexpr double bar = 1e5;
  std::vector<ForceBlock> out;
  const std::vector<double> velocity = velocities(means);
  const double least = moving_speed(velocity);
  const std::vector<double>& position_m = means.column(Channel::position);
  const std::vector<double>& force_N = means.column(Channel::axial_force);
  const std::vector<double>& pressure_Pa = means.column(Channel::pressure_difference);
  if (force_N.empty() || (pressurised && pressure_Pa.empty())) return out;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    const double pressure_bar = pressurised ? pressure_Pa[k] / bar : 0;
    if (std::abs(velocity[k]) <= least || !std::isfinite(force_N[k] + position_m[k] + pressure_bar)) continue;
    out.push_back({force_row(position_m[k], pressure_bar, std::copysign(1.0, velocity[k]), stroke_m), force_N[k]});
  }
  return out;
}

void fit_forces(HydraulicCurves& out, const Recording* spring, const std::vector<const Recording*>& maps) {
  constexpr double bar = 1e5;
  std::vector<std::vector<ForceBlock>> recordings;
  if (spring != nullptr) recordings.push_back(force_blocks(*spring, false, out.stroke_m));
  for (const Recording* map : maps) recordings.push_back(force_blocks(*map, true, out.stroke_m));
  SparseFit fit(2 * position_knots + 1);
  double least = 0, most = 0;
  for (const std::vector<ForceBlock>& blocks : recordings) {
    for (const ForceBlock& block : blocks) {
      fit.add(block.row, block.force_N);
      least = std::min(least, block.force_N);
      most = std::max(most, block.force_N);
    }
  }
  const std::vector<double> solution = fit.solve();
  out.spring_N.assign(solution.begin(), solution.begin() + position_knots);
  out.force_per_Pa.assign(solution.begin() + position_knots, solution.begin() + 2 * position_knots);
  for (double& per_bar : out.force_per_Pa) per_bar /= bar;
  out.friction_N = std::abs(solution[2 * position_knots]);
  out.force_range_N = most - least;
  for (const std::vector<ForceBlock>& blocks : recordings) {
    double sum = 0;
    for (const ForceBlock& block : blocks) sum += squared(block.force_N - of(block.row, solution));
    if (!blocks.empty())
      out.force_residual_N = std::max(out.force_residual_N, std::sqrt(sum / static_cast<double>(blocks.size())));
  }
}

/// Calls with position, pressure difference and flow of each block under pressure.
template <class Each>
void each_flow(const std::vector<const Recording*>& maps, const Each& each) {
  for (const Recording* map : maps) {
    const std::vector<double>& position_m = map->column(Channel::position);
    const std::vector<double>& pressure_Pa = map->column(Channel::pressure_difference);
    const std::vector<double>& flow = map->column(Channel::flow);
    if (pressure_Pa.empty() || flow.empty()) continue;
    for (std::size_t k = 0; k < flow.size(); ++k) {
      if (pressure_Pa[k] > least_pressure_Pa && std::isfinite(flow[k] + position_m[k] + pressure_Pa[k]))
        each(position_m[k], pressure_Pa[k], flow[k]);
    }
  }
}

void fit_flows(HydraulicCurves& out, const std::vector<const Recording*>& maps) {
  SparseFit fit(position_knots);
  each_flow(maps, [&](double position_m, double pressure_Pa, double flow) {
    auto row = between_knots(position_m, out.stroke_m, position_knots);
    for (Weight& weight : row) weight.factor *= std::sqrt(pressure_Pa);
    fit.add(row, flow);
    out.highest_pressure_Pa = std::max(out.highest_pressure_Pa, pressure_Pa);
    out.largest_flow_m3_per_s = std::max(out.largest_flow_m3_per_s, std::abs(flow));
  });
  out.conductance = fit.solve();
  double sum = 0, count = 0;
  each_flow(maps, [&](double position_m, double pressure_Pa, double flow) {
    sum += squared(flow - out.conductance_at(position_m) * std::sqrt(pressure_Pa));
    ++count;
  });
  if (count > 0) out.flow_residual_m3_per_s = std::sqrt(sum / count);
}

/// Where the opening is no longer small, by least squares.
double momentum_share(const HydraulicCurves& curves, const std::vector<const Recording*>& maps, double density) {
  constexpr double from_stroke = 0.2;
  double product = 0, square = 0;
  each_flow(maps, [&](double position_m, double pressure_Pa, double flow) {
    if (position_m < from_stroke * curves.stroke_m) return;
    const double momentum_N = flow * std::sqrt(2 * density * pressure_Pa);
    product += curves.force_per_Pa_at(position_m) * pressure_Pa * momentum_N;
    square += squared(momentum_N);
  });
  return square > 0 ? product / square : std::nan("");
}

/// NaN where the position is not known.
double on_knots(const std::vector<double>& knots, double position_m, double stroke_m) {
  if (!std::isfinite(position_m)) return std::nan("");
  return of(between_knots(position_m, stroke_m, position_knots), knots);
}

std::array<Weight, 4> map_row(double current_A, double position_m, double largest_A, double stroke_m) {
  const auto current = between_knots(current_A, largest_A, map_knots);
  const auto position = between_knots(position_m, stroke_m, map_knots);
  std::array<Weight, 4> out{};
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = {current[k / 2].unknown * map_knots + position[k % 2].unknown,
              current[k / 2].factor * position[k % 2].factor};
  }
  return out;
}

}  // namespace

double HydraulicCurves::spring_at(double position_m) const {
  return on_knots(spring_N, position_m, stroke_m);
}

double HydraulicCurves::force_per_Pa_at(double position_m) const {
  return on_knots(force_per_Pa, position_m, stroke_m);
}

double HydraulicCurves::conductance_at(double position_m) const {
  return on_knots(conductance, position_m, stroke_m);
}

HydraulicCurves fit_hydraulics(const Recording* spring, const std::vector<const Recording*>& maps, double stroke_m,
                               double density_kg_per_m3) {
  HydraulicCurves out;
  out.stroke_m = stroke_m;
  fit_forces(out, spring, maps);
  fit_flows(out, maps);
  out.jet_momentum_share = momentum_share(out, maps, density_kg_per_m3);
  return out;
}

MapRatios map_ratios(const HydraulicCurves& curves, const Recording& map) {
  constexpr double from_stroke = 0.3, from_pressure = 0.2;
  std::vector<double> flows;
  each_flow({&map}, [&](double position_m, double pressure_Pa, double flow) {
    const double expected = curves.conductance_at(position_m) * std::sqrt(pressure_Pa);
    const bool open = position_m > from_stroke * curves.stroke_m && expected > 0;
    if (open && pressure_Pa > from_pressure * curves.highest_pressure_Pa) flows.push_back(flow / expected);
  });
  enum : std::uint8_t { flow_force, spring, friction, unknowns };
  SparseFit fit(unknowns);
  const std::vector<double> velocity = velocities(map);
  const double least = moving_speed(velocity);
  const std::vector<double>& position_m = map.column(Channel::position);
  const std::vector<double>& force_N = map.column(Channel::axial_force);
  const std::vector<double>& pressure_Pa = map.column(Channel::pressure_difference);
  double blocks = 0;
  for (std::size_t k = 0; k < velocity.size() && !force_N.empty() && !pressure_Pa.empty(); ++k) {
    if (std::abs(velocity[k]) <= least || !std::isfinite(force_N[k] + position_m[k] + pressure_Pa[k])) continue;
    const std::array<Weight, unknowns> row{Weight{flow_force, curves.force_per_Pa_at(position_m[k]) * pressure_Pa[k]},
                                           Weight{spring, curves.spring_at(position_m[k])},
                                           Weight{friction, std::copysign(1.0, velocity[k])}};
    fit.add(row, force_N[k]);
    ++blocks;
  }
  const bool enough = static_cast<double>(flows.size()) >= least_blocks;
  return {enough ? numerics::median(std::move(flows)) : std::nan(""),
          blocks >= least_blocks ? fit.solve()[flow_force] : std::nan("")};
}

double MagneticCurves::at(double current_A, double position_m) const {
  if (!std::isfinite(current_A) || !std::isfinite(position_m)) return std::nan("");
  return of(map_row(current_A, position_m, largest_current_A, stroke_m), force_N);
}

MagneticCurves fit_magnetics(const Recording& map, double stroke_m) {
  MagneticCurves out;
  out.stroke_m = stroke_m;
  const std::vector<double>& current_A = map.column(Channel::current);
  const std::vector<double>& position_m = map.column(Channel::position);
  const std::vector<double>& force_N = map.column(Channel::force);
  const auto usable = [&](std::size_t k) { return std::isfinite(current_A[k] + position_m[k] + force_N[k]); };
  double least = 0, most = 0;
  for (std::size_t k = 0; k < map.size(); ++k) {
    if (!usable(k)) continue;
    out.largest_current_A = std::max(out.largest_current_A, current_A[k]);
    least = std::min(least, force_N[k]);
    most = std::max(most, force_N[k]);
  }
  out.range_N = most - least;
  out.largest_current_A = std::max(out.largest_current_A, 1e-9);
  SparseFit fit(map_knots * map_knots);
  for (std::size_t k = 0; k < map.size(); ++k) {
    if (usable(k)) fit.add(map_row(current_A[k], position_m[k], out.largest_current_A, stroke_m), force_N[k]);
  }
  out.force_N = fit.solve();
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < map.size(); ++k) {
    if (!usable(k)) continue;
    sum += squared(force_N[k] - out.at(current_A[k], position_m[k]));
    ++count;
  }
  if (count > 0) out.residual_N = std::sqrt(sum / count);
  std::array<double, map_knots> over_position_N{};
  for (std::size_t k = 0; k < out.force_N.size(); ++k) over_position_N[k / map_knots] += out.force_N[k] / map_knots;
  out.mean_N = std::accumulate(over_position_N.begin(), over_position_N.end(), 0.0) / map_knots;
  out.rises = std::ranges::adjacent_find(over_position_N, std::ranges::greater_equal{}) == over_position_N.end();
  return out;
}

}  // namespace spoolflow::plausibility
