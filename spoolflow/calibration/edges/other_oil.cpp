#include "spoolflow/calibration/edges/other_oil.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/QR>

#include "spoolflow/model/oil.hpp"

namespace spoolflow::calibration {
namespace {

/// The oil of a layer over that of the measurement.
struct OtherOil {
  double density;
  double viscosity;
};

/// Unknowns of y = a u + b v.
struct TwoParts {
  double a;
  double b;
};

TwoParts fit_two_parts(const std::vector<std::array<double, 3>>& rows) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), 2);
  Eigen::VectorXd right(matrix.rows());
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    const std::array<double, 3>& row = rows[static_cast<std::size_t>(k)];
    matrix.row(k) << row[0], row[1];
    right[k] = row[2];
  }
  const Eigen::Vector2d solution = matrix.colPivHouseholderQr().solve(right);
  return {solution[0], solution[1]};
}

/// dp = a Q^2 + b Q.
double flow_at(const TwoParts& law, double pressure_Pa) {
  return 2 * pressure_Pa / (law.b + std::sqrt(law.b * law.b + 4 * law.a * pressure_Pa));
}

/// By how much the conductance changes at each pressure difference.
std::vector<double> conductance_ratios(const std::vector<double>& pressures_Pa, const std::vector<double>& conductance,
                                       const OtherOil& oil) {
  std::vector<std::array<double, 3>> rows;  // dp over Q^2: one equation a level, each as certain
  for (std::size_t k = 0; k < pressures_Pa.size(); ++k) {
    const double flow = conductance[k] * std::sqrt(pressures_Pa[k]);
    if (flow > 0) rows.push_back({1, 1 / flow, pressures_Pa[k] / (flow * flow)});
  }
  std::vector<double> out(pressures_Pa.size(), 1 / std::sqrt(oil.density));
  if (rows.size() < 2) return out;
  const TwoParts law = fit_two_parts(rows);
  if (!(law.a > 0 && law.b > 0)) return out;
  const TwoParts of_oil{law.a * oil.density, law.b * oil.density * oil.viscosity};
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = flow_at(of_oil, pressures_Pa[k]) / flow_at(law, pressures_Pa[k]);
  return out;
}

/// By how much the flow force changes at each pressure difference: F = a dp + b dp^(3/4), of which the second part goes
/// with the root of viscosity.
std::vector<double> force_ratios(const std::vector<double>& pressures_Pa, const std::vector<double>& force_N,
                                 const OtherOil& oil) {
  constexpr double most_change = 0.3;
  std::vector<std::array<double, 3>> rows;
  for (std::size_t k = 0; k < pressures_Pa.size(); ++k)
    rows.push_back({pressures_Pa[k], std::pow(pressures_Pa[k], 0.75), force_N[k]});
  const TwoParts law = fit_two_parts(rows);
  std::vector<double> out;
  for (const auto& [linear, boundary, force] : rows) {
    const double measured = law.a * linear + law.b * boundary;
    const double ratio = (law.a * linear + law.b * boundary * std::sqrt(oil.viscosity)) / measured;
    out.push_back(measured > 0 ? std::clamp(ratio, 1 - most_change, 1 + most_change) : 1);
  }
  return out;
}

}  // namespace

void continue_to_other_oil(sensor::MeteringEdge<double>& edge, double measured_K, const model::Fluid& fluid) {
  std::vector<double> pressures_Pa;
  for (int row = 1; row < sensor::edge_pressures; ++row) pressures_Pa.push_back(edge.pressure_difference_Pa.at(row));
  for (int layer = 0; layer < sensor::edge_temperatures; ++layer) {
    const double layer_K = edge.temperature_K.at(layer);
    const OtherOil oil{1 - model::thermal_expansion_per_K * (layer_K - measured_K),
                       model::viscosity_m2_per_s(fluid, layer_K) / model::viscosity_m2_per_s(fluid, measured_K)};
    for (int column = 0; column < sensor::edge_positions; ++column) {
      std::vector<double> conductance, force_N;
      for (int row = 1; row < sensor::edge_pressures; ++row) {
        conductance.push_back(edge.conductance.node(layer, row, column));
        force_N.push_back(edge.flow_force_N.node(layer, row, column));
      }
      const std::vector<double> of_conductance = conductance_ratios(pressures_Pa, conductance, oil),
                                of_force = force_ratios(pressures_Pa, force_N, oil);
      for (int row = 0; row < sensor::edge_pressures; ++row) {
        const auto k = static_cast<std::size_t>(std::max(row - 1, 0));  // without pressure: as at the lowest
        edge.conductance.node(layer, row, column) *= of_conductance[k];
        edge.flow_force_N.node(layer, row, column) *= of_force[k];
      }
    }
  }
}

}  // namespace spoolflow::calibration
