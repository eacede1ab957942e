#include "spoolflow/calibration/flow_bench/coenergy.hpp"

#include <algorithm>

#include <Eigen/QR>

namespace spoolflow::calibration {
namespace {

constexpr int order = 4;
constexpr int no_current_row = sensor::flux_map_currents_below_zero;
constexpr int columns = sensor::flux_map_positions;

/// The coenergy over the current at one column of positions.
double coenergy_J(const sensor::FluxLinkage<double>& flux_linkage, int column, double current_A) {
  const auto& map = flux_linkage.map;
  double sum_J = 0;
  for (int row = no_current_row; row + 1 < sensor::flux_map_currents; ++row) {
    const double from_A = map.row_axis.at(row);
    if (from_A >= current_A) break;
    const double step_A = std::min(map.row_axis.at(row + 1), current_A) - from_A;
    const double slope = (map.node(row + 1, column) - map.node(row, column)) * map.row_axis.per_spacing;
    sum_J += step_A * (map.node(row, column) + 0.5 * slope * step_A);
  }
  return sum_J;
}

}  // namespace

sensor::MagneticForce<double> empty_force_map(double largest_A, double stroke_m) {
  sensor::MagneticForce<double> out{};
  const double step_A = largest_A / (sensor::force_map_currents - 1);
  const double step_m = stroke_m / (sensor::force_map_positions - 1);
  out.map.row_axis = {0, step_A, 1 / step_A};
  out.map.column_axis = {0, step_m, 1 / step_m};
  out.hysteresis_half_width_N.axis = out.map.row_axis;
  return out;
}

sensor::MagneticForce<double> force_of_coenergy(const sensor::FluxLinkage<double>& flux_linkage) {
  const auto& flux = flux_linkage.map;
  const double largest_A = flux.row_axis.at(sensor::flux_map_currents - 1 - no_current_row);
  const double stroke_m = flux.column_axis.at(columns - 1) - flux.column_axis.first;
  sensor::MagneticForce<double> out = empty_force_map(largest_A, stroke_m);
  out.map.column_axis.first = flux.column_axis.first;
  Eigen::MatrixXd powers(columns, order + 1);
  for (int c = 0; c < columns; ++c) {
    double power = 1;
    for (int k = 0; k <= order; ++k, power *= static_cast<double>(c) / (columns - 1)) powers(c, k) = power;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(powers);
  for (int row = 0; row < sensor::force_map_currents; ++row) {
    Eigen::VectorXd energy(columns);
    for (int c = 0; c < columns; ++c) energy(c) = coenergy_J(flux_linkage, c, out.map.row_axis.at(row));
    const Eigen::VectorXd shape = solver.solve(energy);
    for (int column = 0; column < sensor::force_map_positions; ++column) {
      const double share = static_cast<double>(column) / (sensor::force_map_positions - 1);
      double slope = 0, power = 1;
      for (int k = 1; k <= order; ++k, power *= share) slope += k * shape(k) * power;
      out.map.node(row, column) = std::max(0.0, slope / stroke_m);
    }
  }
  return out;
}

}  // namespace spoolflow::calibration
