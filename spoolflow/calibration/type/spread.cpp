#include "spoolflow/calibration/type/spread.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/numerics/crossing.hpp"

namespace spoolflow::calibration {
namespace {

constexpr int openings = 12;

struct Point {
  double position_m, pressure_Pa, current_A;
};

/// What a deviation changes at a point, over what is there.
struct Effects {
  double force_N, friction_N, conductance;
};

Effects effects_at(const sensor::ObserverParameters<double>& unit, const Point& point) {
  const double temperature_K = unit.edge.temperature_K.at(1);
  const sensor::EdgePoint<double> edge = unit.edge.at(temperature_K, point.pressure_Pa, point.position_m);
  return {unit.actuator.magnetic_force.at(point.current_A, point.position_m).value -
              unit.spring.at(point.position_m).value - edge.flow_force_N,
          edge.friction_N + unit.actuator.friction_N.at(point.current_A, point.position_m).value, edge.conductance};
}

/// The magnetising current that holds spring and flow force.
double balance_current_A(const sensor::ObserverParameters<double>& unit, double position_m, double pressure_Pa) {
  const double wanted_N = unit.spring.at(position_m).value +
                          unit.edge.at(unit.edge.temperature_K.at(1), pressure_Pa, position_m).flow_force_N;
  return numerics::crossing({0, unit.largest_current_A}, wanted_N, [&](double current_A) {
    return unit.actuator.magnetic_force.at(current_A, position_m).value;
  });
}

/// Openings beyond the closed part at pressures from a tenth of the highest on.
std::vector<Point> grid(const sensor::ObserverParameters<double>& unit) {
  std::vector<Point> out;
  const double open_m = unit.closed_below_m, end_m = unit.edge.position_m.at(sensor::edge_positions - 1);
  for (int k = 1; k <= openings; ++k) {
    for (const double share : {0.15, 0.4, 0.7, 1.0}) {
      const double position_m = open_m + (end_m - open_m) * k / (openings + 1);
      const double pressure_Pa = share * unit.edge.highest_pressure_difference_Pa();
      out.push_back({position_m, pressure_Pa, balance_current_A(unit, position_m, pressure_Pa)});
    }
  }
  return out;
}

/// Slopes of the effects at every point over the deviations, one column each; three rows a point.
Eigen::MatrixXd effect_slopes(const sensor::ObserverParameters<double>& unit, const std::vector<Point>& points,
                              const Eigen::VectorXd& deviation) {
  Eigen::MatrixXd out(3 * static_cast<Eigen::Index>(points.size()), deviating);
  constexpr double step = 0.2;
  for (Eigen::Index k = 0; k < deviating; ++k) {
    Deviations turned{};
    const double turn = step * std::max(deviation(k), 1e-9);
    turned[static_cast<std::size_t>(k)] = turn;
    const sensor::ObserverParameters<double> other = unit_parameters(unit, turned);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Effects here = effects_at(unit, points[p]), there = effects_at(other, points[p]);
      const auto row = 3 * static_cast<Eigen::Index>(p);
      out(row, k) = (there.force_N - here.force_N) / turn;
      out(row + 1, k) = (there.friction_N - here.friction_N) / turn / std::max(here.friction_N, 1e-6);
      out(row + 2, k) = (there.conductance - here.conductance) / turn / std::max(here.conductance, 1e-15);
    }
  }
  return out;
}

}  // namespace

UnitSpread spread_of(const sensor::ObserverParameters<double>& unit, const KnownDeviations& known) {
  const std::vector<Point> points = grid(unit);
  const Eigen::MatrixXd slope = effect_slopes(unit, points, known.covariance.diagonal().cwiseSqrt());
  const Eigen::VectorXd variance = (slope * known.covariance).cwiseProduct(slope).rowwise().sum();
  double force = 0, friction = 0, flow = 0;
  for (Eigen::Index p = 0; p < variance.size(); p += 3) {
    force += variance(p);
    friction += variance(p + 1);
    flow += variance(p + 2);
  }
  const auto count = static_cast<double>(points.size());
  return {std::sqrt(force / count), std::sqrt(friction / count), std::sqrt(flow / count)};
}

}  // namespace spoolflow::calibration
