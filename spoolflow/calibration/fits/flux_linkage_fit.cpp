#include "spoolflow/calibration/fits/flux_linkage_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

constexpr int flux_rows = sensor::flux_map_currents;
constexpr int flux_columns = sensor::flux_map_positions;
constexpr int zero_row = sensor::flux_map_currents_below_zero;
constexpr int nodes = (flux_rows - zero_row - 1) * flux_columns;
constexpr std::size_t window_samples = 13;  // long against the noise, short against a sine's period
/// Longer windows end where current or position has changed by this share of a cell of the map, ...
constexpr double longer_window_cells = 0.5;
/// ... and the current by less than so many deviations of its noise from sample to sample: within a step that it
/// takes between two samples its value at their end is not known.
constexpr double quiet_deviations = 4;
constexpr double knot_distance_s = 15;  // a coil warms in minutes

using FluxMap = sensor::Map<double, flux_rows, flux_columns>;

FluxMap empty_map(const sensor::MagneticForce<double>& magnetic_force) {
  FluxMap map{};
  const auto& force = magnetic_force.map;
  const double step_A = force.row_axis.at(sensor::force_map_currents - 1) / (flux_rows - 1 - 2 * zero_row);
  map.row_axis = {-zero_row * step_A, step_A, 1 / step_A};
  const double first_m = force.column_axis.first;
  const double step_m = (force.column_axis.at(sensor::force_map_positions - 1) - first_m) / (flux_columns - 1);
  map.column_axis = {first_m, step_m, 1 / step_m};
  return map;
}

/// A row of the equations: unknown and its share. Unknowns are the nodes above zero current, then resistances at knots.
using Shares = std::vector<std::pair<int, double>>;

/// Nodes below zero current mirror those above; there is no flux without current.
void add_node(Shares& shares, int row, int column, double share) {
  const int above = row - zero_row;
  if (above == 0 || share == 0) return;
  shares.emplace_back((std::abs(above) - 1) * flux_columns + column, above > 0 ? share : -share);
}

void add_flux(Shares& shares, const FluxMap& map, double current_A, double position_m, double sign) {
  const auto row = sensor::locate<flux_rows>(map.row_axis, current_A);
  const auto column = sensor::locate<flux_columns>(map.column_axis, position_m);
  add_node(shares, row.index, column.index, sign * (1 - row.share) * (1 - column.share));
  add_node(shares, row.index, column.index + 1, sign * (1 - row.share) * column.share);
  add_node(shares, row.index + 1, column.index, sign * row.share * (1 - column.share));
  add_node(shares, row.index + 1, column.index + 1, sign * row.share * column.share);
}

/// The flux change over one window.
struct FluxChange {
  Shares shares;
  double voltage_integral_Wb = 0;
  double noise_Wb2 = 0;
};

struct FluxChanges {
  FluxMap map;
  std::vector<FluxChange> all;
  int unknowns = nodes;
  double current_noise_A = 0;
  double voltage_noise_V_root_s = 0;  ///< density
  double largest_voltage_V = 0;
  double largest_current_A = 0;
  double resistance_step_Ohm = 0;  ///< by which the resistance is let change from knot to knot
};

struct Window {
  std::size_t begin, end;
};

/// What the current of a quiet coil changes by from sample to sample at most.
double quiet_change_A(const SolenoidSamples& samples) {
  std::vector<double> current_A;
  for (const auto& sample : samples.samples) current_A.push_back(sample.current_A);
  const double largest_A = std::ranges::max(current_A, {}, [](double each) { return std::abs(each); });
  return std::fmax(quiet_deviations * noise_of(current_A), 1e-3 * largest_A);
}

/// Successive windows of a recording.
std::vector<Window> windows_of(const FluxEvidence& evidence, const FluxMap& map) {
  const SolenoidSamples& s = *evidence.samples;
  const double quiet_A = evidence.longest_window_s > 0 ? quiet_change_A(s) : 0;
  const auto change_A = [&](std::size_t from, std::size_t to) {
    return std::abs(s.samples[to].current_A - s.samples[from].current_A);
  };
  const auto quiet = [&](std::size_t k) {
    return k + 1 >= s.size() || (change_A(k - 1, k) < quiet_A && change_A(k, k + 1) < quiet_A);
  };
  std::vector<Window> out;
  for (std::size_t begin = 0; begin + window_samples < s.size(); begin = out.back().end) {
    std::size_t end = begin + window_samples;
    const auto goes_on = [&] {
      const double lasts_s = s.time_s[end] - s.time_s[begin];
      if (!quiet(end)) return lasts_s < 2 * evidence.longest_window_s;
      return lasts_s < evidence.longest_window_s && change_A(begin, end) < longer_window_cells * map.row_axis.spacing &&
             std::abs(s.samples[end].position_m - s.samples[begin].position_m) <
                 longer_window_cells * map.column_axis.spacing;
    };
    while (end + 1 < s.size() && s.restarts[end] == 0 && goes_on()) ++end;
    out.push_back({begin, end});
  }
  return out;
}

/// What the coil's resistance takes of the voltage in one sample, as shares of its values at the knots before and
/// after.
void add_resistance(Shares& shares, int first_knot, double knot, double current_A_s) {
  const int lower = static_cast<int>(knot);
  const double of_upper = knot - lower;
  for (const auto& [unknown, share] :
       {std::pair{first_knot + lower, 1 - of_upper}, {first_knot + lower + 1, of_upper}}) {
    const auto known = std::ranges::find(shares, unknown, &std::pair<int, double>::first);
    if (known == shares.end()) {
      shares.emplace_back(unknown, share * current_A_s);
    } else {
      known->second += share * current_A_s;
    }
  }
}

void add_changes(FluxChanges& changes, const FluxEvidence& evidence) {
  const SolenoidSamples& s = *evidence.samples;
  std::vector<double> voltage_V;
  if (!s.has_voltage() || s.size() <= window_samples) return;
  double steps_s = 0;
  for (const auto& sample : s.samples) {
    voltage_V.push_back(sample.voltage_V);
    steps_s += sample.time_step_s;
    changes.largest_voltage_V = std::fmax(changes.largest_voltage_V, std::abs(sample.voltage_V));
    changes.largest_current_A = std::fmax(changes.largest_current_A, std::abs(sample.current_A));
  }
  const double voltage_noise_V = noise_of(voltage_V);
  changes.voltage_noise_V_root_s =
      std::max(changes.voltage_noise_V_root_s, voltage_noise_V * std::sqrt(steps_s / static_cast<double>(s.size())));
  changes.current_noise_A = std::fmax(changes.current_noise_A, noise_of(evidence.magnetising_current_A));
  const int first_knot = changes.unknowns;
  for (const auto& [begin, end] : windows_of(evidence, changes.map)) {
    if (std::isnan(evidence.magnetising_current_A[begin]) || std::isnan(evidence.magnetising_current_A[end])) continue;
    FluxChange change;
    bool whole = true;
    for (std::size_t k = begin + 1; whole && k <= end; ++k) {
      const auto& sample = s.samples[k];
      const double step_s = sample.time_step_s;
      whole = s.restarts[k] == 0 && !std::isnan(sample.voltage_V) && step_s > 0;
      change.voltage_integral_Wb += sample.voltage_V * step_s;
      change.noise_Wb2 += voltage_noise_V * voltage_noise_V * step_s * step_s;
      add_resistance(change.shares, first_knot, (s.time_s[k] - s.time_s.front()) / knot_distance_s,
                     sample.current_A * step_s);
    }
    if (!whole) continue;
    add_flux(change.shares, changes.map, evidence.magnetising_current_A[end], s.samples[end].position_m, 1);
    add_flux(change.shares, changes.map, evidence.magnetising_current_A[begin], s.samples[begin].position_m, -1);
    changes.all.push_back(std::move(change));
  }
  changes.unknowns += 2 + static_cast<int>((s.time_s.back() - s.time_s.front()) / knot_distance_s);
}

struct Solution {
  Eigen::VectorXd unknowns;
  Eigen::MatrixXd covariance;
};

void add_equation(Eigen::MatrixXd& matrix, const Shares& shares, double weight) {
  for (const auto& [r, share_r] : shares)
    for (const auto& [c, share_c] : shares) matrix(r, c) += weight * share_r * share_c;
}

/// Smoothness keeps unknowns that no sample reached near their neighbours: second differences of the flux vanish within
/// `allowed_Wb`, first differences of the resistance, from knot to knot, within `allowed_Ohm`.
void add_smoothness(Eigen::MatrixXd& matrix, double allowed_Wb, double allowed_Ohm) {
  const double weight = 1 / (allowed_Wb * allowed_Wb);
  const auto add = [&](std::array<std::pair<int, int>, 3> three, double strength) {
    Shares shares;
    const std::array<double, 3> difference{1, -2, 1};
    for (std::size_t n = 0; n < 3; ++n) add_node(shares, three[n].first, three[n].second, difference[n]);
    add_equation(matrix, shares, strength * weight);
  };
  for (int row = zero_row + 1; row < flux_rows; ++row) {
    for (int column = 0; column < flux_columns; ++column) {
      if (row + 1 < flux_rows) add({{{row - 1, column}, {row, column}, {row + 1, column}}}, 1);
      if (column > 0 && column + 1 < flux_columns) add({{{row, column - 1}, {row, column}, {row, column + 1}}}, 0.3);
    }
  }
  for (int k = nodes; k + 1 < matrix.rows(); ++k)
    add_equation(matrix, {{k, -1.0}, {k + 1, 1.0}}, 1 / (allowed_Ohm * allowed_Ohm));
}

double deviation_of(const FluxChange& change, const Eigen::VectorXd& unknowns) {
  double explained = 0;
  for (const auto& [k, share] : change.shares) explained += share * unknowns(k);
  return change.voltage_integral_Wb - explained;
}

/// `inductance_H` turns noise of the magnetising current into flux. Changes that the solution `before` misses by far
/// are left out: the recorder's samples did not resolve them.
Solution solve(const FluxChanges& changes, double inductance_H, const Eigen::VectorXd* before, FluxLinkageFit& fit) {
  constexpr double far_in_deviations = 5;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(changes.unknowns, changes.unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(changes.unknowns);
  const double end_noise_Wb = inductance_H * changes.current_noise_A;
  std::vector<double> misfits;
  fit.residual = {};
  for (const FluxChange& change : changes.all) {
    const double variance = change.noise_Wb2 + 2 * end_noise_Wb * end_noise_Wb;
    if (before != nullptr) {
      const double deviation = deviation_of(change, *before);
      misfits.push_back(deviation * deviation / variance);
      if (misfits.back() > far_in_deviations * far_in_deviations * std::max(fit.misfit, 1.0)) continue;
      fit.residual.add(deviation);
    }
    add_equation(matrix, change.shares, 1 / variance);
    for (const auto& [k, share] : change.shares) right(k) += share * change.voltage_integral_Wb / variance;
  }
  if (!misfits.empty()) {
    constexpr double median_of_chi_square = 0.455;  // with one degree of freedom
    fit.misfit = numerics::median(std::move(misfits)) / median_of_chi_square;
  }
  const double step_A = changes.map.row_axis.spacing;
  add_smoothness(matrix, 0.03 * inductance_H * step_A, changes.resistance_step_Ohm);
  const Eigen::MatrixXd covariance = numerics::inverse_of_symmetric(matrix);
  return {covariance * right, covariance};
}

/// The resistance where the last recording ends, and how it wandered from knot to knot.
sensor::CoilResistance<double> resistance_of(const FluxChanges& changes, const Solution& solution) {
  const Eigen::Index last = solution.unknowns.size() - 1;
  double lowest_Ohm = solution.unknowns(nodes);
  double highest_Ohm = lowest_Ohm;
  for (Eigen::Index k = nodes; k <= last; ++k) {
    lowest_Ohm = std::min(lowest_Ohm, solution.unknowns(k));
    highest_Ohm = std::max(highest_Ohm, solution.unknowns(k));
  }
  const double resistance_Ohm = solution.unknowns.tail(last + 1 - nodes).mean();
  // Copper changes by 0.39 % per kelvin; a coil at work lies within some 40 K of one on the bench.
  const double uncertainty_Ohm = std::max(0.15 * resistance_Ohm, highest_Ohm - lowest_Ohm);
  // From cold to warm within about ten minutes.
  return {resistance_Ohm, uncertainty_Ohm, uncertainty_Ohm / std::sqrt(600.0), changes.voltage_noise_V_root_s};
}

/// The resistance over the recordings, and the flux at the largest current with the widest and the narrowest gap.
model::Fit known_parameters(const FluxChanges& changes, const Solution& solution, double misfit) {
  const Eigen::Index all = solution.unknowns.size();
  constexpr Eigen::Index last_row = (flux_rows - zero_row - 2) * flux_columns;
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(3, all);
  share.row(0).tail(all - nodes).setConstant(1 / static_cast<double>(all - nodes));
  share(1, last_row) = 1;
  share(2, last_row + flux_columns - 1) = 1;
  const Eigen::VectorXd values = share * solution.unknowns;
  const auto flux_name = [&](int column) {
    return fmt::format("flux_linkage_at_{:.3g}_A_{:.3g}_mm_Wb", changes.map.row_axis.at(flux_rows - 1),
                       1e3 * changes.map.column_axis.at(column));
  };
  return known_from(
      "coil resistance and flux linkage", {"coil_resistance_Ohm", flux_name(0), flux_name(flux_columns - 1)},
      {values(0), values(1), values(2)}, std::max(misfit, 1.0) * (share * solution.covariance * share.transpose()));
}

/// Flux rises with current: a slope of at least a twentieth of the map's mean keeps the sensor's equation solvable.
void fill_nodes(FluxMap& map, const Eigen::VectorXd& unknowns) {
  const double mean_rise =
      unknowns.segment((flux_rows - zero_row - 2) * flux_columns, flux_columns).mean() / (flux_rows - zero_row - 1);
  for (int column = 0; column < flux_columns; ++column) {
    map.node(zero_row, column) = 0;
    double before = 0;
    for (int row = zero_row + 1; row < flux_rows; ++row) {
      const double measured = unknowns((row - zero_row - 1) * flux_columns + column);
      const double flux = std::max(measured, before + 0.05 * mean_rise);
      map.node(row, column) = before = flux;
      if (row <= 2 * zero_row) map.node(2 * zero_row - row, column) = -flux;
    }
  }
}

/// For recordings without voltage: after the root of the force, one weber an ampere at half the current.
FluxMap map_from_force(const sensor::MagneticForce<double>& magnetic_force) {
  FluxMap map = empty_map(magnetic_force);
  const auto root = [&](double current_A, double position_m) {
    return std::sqrt(std::max(magnetic_force.at(current_A, position_m).value, 0.0));
  };
  const double half_A = 0.5 * map.row_axis.at(flux_rows - 1 - zero_row);
  const double scale = half_A / std::max(root(half_A, map.column_axis.at(flux_columns / 2)), 1e-9);
  Eigen::VectorXd unknowns(nodes);
  for (int row = zero_row + 1; row < flux_rows; ++row)
    for (int column = 0; column < flux_columns; ++column)
      unknowns((row - zero_row - 1) * flux_columns + column) =
          scale * root(map.row_axis.at(row), map.column_axis.at(column));
  fill_nodes(map, unknowns);
  return map;
}

}  // namespace

FluxLinkageFit fit_flux_linkage(std::span<const FluxEvidence> evidence,
                                const sensor::MagneticForce<double>& magnetic_force) {
  FluxLinkageFit fit{};
  FluxChanges changes;
  changes.map = empty_map(magnetic_force);
  for (const FluxEvidence& part : evidence) add_changes(changes, part);
  if (changes.all.empty()) {
    fit.flux_linkage.map = map_from_force(magnetic_force);
    return fit;
  }
  fit.measured = true;
  // A solenoid of this kind answers a voltage step within some ten milliseconds: the size of its inductance.
  const double guess_H = 0.03 * changes.largest_voltage_V / changes.largest_current_A;
  changes.resistance_step_Ohm = 0.003 * changes.largest_voltage_V / changes.largest_current_A;
  const Solution first = solve(changes, guess_H, nullptr, fit);
  fit.misfit = 1;
  const double inductance_H =
      first.unknowns.segment(8 * flux_columns, flux_columns).mean() / (9 * changes.map.row_axis.spacing);
  const Solution second = solve(changes, inductance_H, &first.unknowns, fit);
  const Solution last = solve(changes, inductance_H, &second.unknowns, fit);
  fit.flux_linkage.map = changes.map;
  fill_nodes(fit.flux_linkage.map, last.unknowns);
  fit.coil_resistance = resistance_of(changes, last);
  fit.known = known_parameters(changes, last, fit.misfit);
  return fit;
}

}  // namespace spoolflow::calibration
