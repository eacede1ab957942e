#include "spoolflow/plausibility/run_relations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/numerics/largest_magnitude.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// What sound runs stay below.
double least_imbalance_N(const HydraulicCurves& hydraulics) {
  return balance_share * hydraulics.force_range_N + balance_frictions * hydraulics.friction_N;
}

/// What the solenoid pulls beyond springs, the largest flow force and friction at a position [N]; NaN where either is
/// not known.
double pull_beyond_N(const HydraulicCurves& hydraulics, const MagneticCurves& magnetics, double current_A, double x) {
  const double most_N = hydraulics.force_per_Pa_at(x) * hydraulics.highest_bound_Pa();
  return magnetics.at(current_A, x) - hydraulics.spring_at(x) - most_N - 2 * hydraulics.friction_N;
}

/// Whether the solenoid pulls harder, in one block of a hundred, than springs, the largest flow force and friction hold
/// at the recorded position: the spool must have opened further.
bool asks_for_more(const HydraulicCurves& hydraulics, const MagneticCurves& magnetics, const Recording& run) {
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& current_A = run.column(Channel::current);
  constexpr std::size_t fewest = 3, one_of = 100;
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < current_A.size(); ++k) {
    const double x = std::max(position_m[k], 0.0);
    beyond += pull_beyond_N(hydraulics, magnetics, current_A[k], x) > least_imbalance_N(hydraulics);
  }
  return beyond >= std::max(fewest, current_A.size() / one_of);
}

/// A valve may well stay closed, unless the solenoid asks for more.
void add_opening(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                 const Recording& run) {
  double highest_m = std::nan("");
  for (const double position_m : run.column(Channel::position)) highest_m = std::fmax(highest_m, position_m);
  if (std::isnan(highest_m)) return;
  constexpr double suspicious = 1.6;
  const bool hardly_opens = highest_m < least_opening * hydraulics.stroke_m &&
                            (!run.has(Channel::current) || asks_for_more(hydraulics, magnetics, run));
  to.push_back({.of = largest_opening,
                .shown = fmt::format("{:.3g} mm{}", units::mm_from_m(highest_m),
                                     hardly_opens ? " under a current that opens it" : ""),
                .over_limit = hardly_opens ? suspicious : 0,
                .file = file_of(run)});
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
    const double beyond_N =
        std::max({0.0, -net_N - 2 * hydraulics.friction_N, pull_beyond_N(hydraulics, magnetics, current_A[k], x)});
    square += beyond_N * beyond_N;
    ++count;
  }
  if (count < least_blocks) return;
  const double beyond_N = std::sqrt(square / count);
  to.push_back({.of = "force that neither springs, flow nor friction explain",
                .shown = fmt::format("{:.2g} N RMS", beyond_N),
                .over_limit = beyond_N / least_imbalance_N(hydraulics),
                .file = file_of(run),
                .blocks = count});
}

/// What friction would have to be in a block of a run, at the measured pressure difference or that of the flow.
struct Imbalance {
  double position_m, error_N, direction;
};

std::vector<Imbalance> imbalances(const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                                  const Recording& run) {
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& current_A = run.column(Channel::current);
  const std::vector<double>& pressure_Pa = run.column(Channel::pressure_difference);
  const std::vector<double>& flow = run.column(Channel::flow);
  const std::vector<double> velocity = velocities(run);
  constexpr double least_share = 0.02;
  const double least_conductance = least_share * std::ranges::max(hydraulics.conductance);
  std::vector<Imbalance> blocks;
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double x = position_m[k];
    const double conductance = hydraulics.conductance_at(x);
    if (!(x > least_opening * hydraulics.stroke_m) || conductance < least_conductance) continue;
    const double pressure = pressure_Pa.empty() ? squared(std::max(flow[k], 0.0) / conductance) : pressure_Pa[k];
    const double error_N =
        magnetics.at(current_A[k], x) - hydraulics.spring_at(x) - hydraulics.force_per_Pa_at(x) * pressure;
    if (std::isfinite(error_N)) blocks.push_back({x, error_N, velocity[k] > 0 ? 1.0 : -1.0});
  }
  return blocks;
}

/// Magnetic force against spring, flow force and friction.
void add_balance(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                 const Recording& run) {
  const std::vector<Imbalance> blocks = imbalances(hydraulics, magnetics, run);
  const auto count = static_cast<double>(blocks.size());
  if (count < least_blocks) return;
  double friction_N = 0, square = 0;
  for (const Imbalance& block : blocks) friction_N += block.error_N * block.direction / count;
  for (const Imbalance& block : blocks) square += squared(block.error_N - friction_N * block.direction) / count;
  to.push_back({.of = "balance of forces in operation",
                .shown = fmt::format("{:.2g} N RMS", std::sqrt(square)),
                .over_limit = std::sqrt(square) / least_imbalance_N(hydraulics),
                .file = file_of(run),
                .blocks = count});
}

struct FlowFit {
  double ratio;     ///< reference over expected flow; NaN where too little is known
  double residual;  ///< RMS of their difference [m3/s]
};

/// Over stretches in which a meter's noise averages out.
FlowFit compared(const Recording& run, std::span<const double> expected_of_row) {
  const std::vector<double>& time_s = run.column(Channel::time);
  const std::vector<double> reference = longer_blocks(time_s, run.column(Channel::flow));
  const std::vector<double> expected = longer_blocks(time_s, expected_of_row);
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

/// The same with the flow as a meter shows it that shows the reference at the beginning; how late it is comes out of
/// both.
FlowFit compared_late(const Recording& run, std::span<const double> expected, FlowFit found) {
  const std::vector<double>& time_s = run.column(Channel::time);
  const std::vector<double>& reference = run.column(Channel::flow);
  for (int round = 0; round < 2 && found.ratio > 0; ++round) {
    std::vector<double> shown(expected.begin(), expected.end());
    for (double& value : shown) value *= found.ratio;
    if (std::isfinite(reference.front())) shown.front() = reference.front();
    const numerics::MeterLag meter =
        numerics::find_meter_lag(time_s, shown, reference, static_cast<std::size_t>(least_blocks))
            .value_or(numerics::MeterLag{});
    numerics::apply_lag<double>(time_s, shown, meter);
    for (double& value : shown) value /= found.ratio;
    found = compared(run, shown);
  }
  return found;
}

/// The reference against what edge and pressure difference make, shown as late as the meter is where that matters. A
/// valve that hardly lets oil through shows no ratio, and a meter's noise then nothing.
void add_flow_deviations(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const Recording& run) {
  const auto [earliest, latest] = std::ranges::minmax(run.column(Channel::time));
  if (!(latest - earliest >= shortest_metered_s)) return;
  const std::vector<double> expected = expected_flow(hydraulics, run);
  const double largest = numerics::largest_magnitude(expected);
  FlowFit found = compared(run, expected);
  if (!std::isfinite(found.ratio)) return;
  const double readable = least_flow * hydraulics.largest_flow_m3_per_s;
  const double most = run_flow_residual_share * std::max(largest, readable);
  if (found.ratio > 0 && found.residual > most) found = compared_late(run, expected, found);
  if (largest >= readable) {
    to.push_back({.of = reference_ratio,
                  .shown = fmt::format("{:.3g}", found.ratio),
                  .over_limit = factor_over(found.ratio, 1, run_flow_factor),
                  .file = file_of(run),
                  .ratio = found.ratio});
  }
  to.push_back({.of = "reference flow less that of edge and pressure difference",
                .shown = fmt::format("{:.2g} L/min RMS", units::L_per_min_from_m3_per_s(found.residual)),
                .over_limit = found.residual / most,
                .file = file_of(run)});
}

}  // namespace

Recording one_side(const Recording& run, int side) {
  const bool active = !recording::has_both_coils(run);
  const Channel current = active ? Channel::current : side > 0 ? Channel::current_b : Channel::current_a;
  const Channel voltage = active ? Channel::voltage : side > 0 ? Channel::voltage_b : Channel::voltage_a;
  const std::array<std::pair<Channel, Channel>, 6> taken{
      {{Channel::time, Channel::time},
       {Channel::position, Channel::position},
       {Channel::current, current},
       {Channel::voltage, voltage},
       {Channel::flow, Channel::flow},
       {Channel::pressure_difference, Channel::pressure_difference}}};
  Recording out{run.file, {}};
  const std::vector<double>& position_m = run.column(Channel::position);
  for (const auto& [to, from] : taken) {
    if (!run.has(from)) continue;
    const bool is_signed = to == Channel::position || to == Channel::flow;
    for (std::size_t k = 0; k < position_m.size(); ++k) {
      if (side * position_m[k] > 0) out.column(to).push_back((is_signed ? side : 1) * run.column(from)[k]);
    }
  }
  return out;
}

void keep_known_side(Recording& run, double stroke_m) {
  constexpr double through_share = 0.6;  // of the stroke, to each side
  const std::vector<double> position_m = run.column(Channel::position);
  const auto reaches = [&](int side) {
    return std::ranges::any_of(position_m, [&](double at_m) { return side * at_m > through_share * stroke_m; });
  };
  if (!reaches(1) || !reaches(-1)) return;
  for (const Channel channel : recording::all_channels) {
    std::size_t k = 0;
    std::erase_if(run.column(channel), [&](double) { return position_m[k++] < 0; });
  }
}

std::vector<double> expected_flow(const HydraulicCurves& hydraulics, const Recording& run) {
  const std::vector<double>& position_m = run.column(Channel::position);
  const std::vector<double>& pressure_Pa = run.column(Channel::pressure_difference);
  std::vector<double> out(run.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double conductance = std::max(hydraulics.conductance_at(std::max(position_m[k], 0.0)), 0.0);
    const double pressure = pressure_Pa.empty() ? hydraulics.highest_pressure_Pa : pressure_Pa[k];
    out[k] = conductance * std::copysign(std::sqrt(std::abs(pressure)), pressure);
  }
  return out;
}

void add_run_deviations(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                        const Recording& run) {
  const Recording slow = longer_blocks(run);
  add_travel(to, slow, hydraulics.stroke_m, false);
  add_opening(to, hydraulics, magnetics, slow);
  const bool with_pressure = run.has(Channel::pressure_difference), with_flow = run.has(Channel::flow);
  if (run.has(Channel::current)) {
    if (with_pressure || with_flow) {
      add_balance(to, hydraulics, magnetics, slow);
    } else {
      add_force_bounds(to, hydraulics, magnetics, slow);
    }
  }
  if (with_pressure && with_flow) add_flow_deviations(to, hydraulics, run);
}

std::string undeclared_open_stop(const KnownValve& valve, const Recording& run) {
  if (valve.open_stop_is_known || !run.has(Channel::current) ||
      (!run.has(Channel::pressure_difference) && !run.has(Channel::flow)))
    return {};
  const std::vector<Imbalance> blocks = imbalances(valve.hydraulics, valve.magnetics, longer_blocks(run));
  if (static_cast<double>(blocks.size()) < least_blocks) return {};
  constexpr double one_place_m = 5e-6, clear_m = 50e-6, near_share = 0.5;
  constexpr std::size_t fewest = 10;
  const double highest_m = std::ranges::max(blocks, {}, &Imbalance::position_m).position_m;
  std::vector<double> there_N, below_N;
  for (const auto& [position_m, error_N, direction] : blocks) {
    if (position_m > highest_m - one_place_m) there_N.push_back(error_N);
    if (position_m < highest_m - clear_m && position_m > near_share * highest_m) below_N.push_back(error_N);
  }
  if (there_N.size() < fewest || below_N.size() < fewest) return {};
  const double held_N = numerics::quantile(std::move(there_N), 0.75) - numerics::quantile(std::move(below_N), 0.99);
  if (held_N < std::max(open_stop_frictions * valve.hydraulics.friction_N, least_imbalance_N(valve.hydraulics)))
    return {};
  const double position_mm = units::mm_from_m(highest_m);
  return fmt::format(
      "the spool stands at {:.3f} mm and no higher, where the solenoid pulls {:.1f} N harder than springs, flow force "
      "and friction hold below: its open stop; without [valve] open_stop_mm = {:.3f} in the campaign or the unit's "
      "file, that force passes for flow",
      position_mm, held_N, position_mm);
}

}  // namespace spoolflow::plausibility
