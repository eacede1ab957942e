#include "spoolflow/calibration/type/unit_effects.hpp"

#include <algorithm>

#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/numerics/crossing.hpp"

namespace spoolflow::calibration {

UnitEffects effects_at(const sensor::ObserverParameters<double>& unit, const OperatingPoint& point) {
  const double temperature_K = unit.edge.temperature_K.at(1);
  const sensor::EdgePoint<double> edge = unit.edge.at(temperature_K, point.pressure_Pa, point.position_m);
  const sensor::ActuatorParameters<double>& actuator = unit.actuator;
  return {actuator.magnetic_force.at(point.current_A, point.position_m).value - unit.spring.at(point.position_m).value -
              edge.flow_force_N,
          edge.friction_N + actuator.friction_N.at(point.current_A, point.position_m).value,
          actuator.magnetic_force.hysteresis_half_width_N.at(point.current_A).value, edge.conductance,
          edge.flow_force_N};
}

OperatingPoint balanced_point(const sensor::ObserverParameters<double>& unit, double position_m, double pressure_Pa) {
  const double wanted_N = unit.spring.at(position_m).value +
                          unit.edge.at(unit.edge.temperature_K.at(1), pressure_Pa, position_m).flow_force_N;
  const double current_A = numerics::crossing({0, unit.largest_current_A}, wanted_N, [&](double candidate_A) {
    return unit.actuator.magnetic_force.at(candidate_A, position_m).value;
  });
  return {position_m, pressure_Pa, current_A};
}

std::vector<OperatingPoint> operating_points(const sensor::ObserverParameters<double>& unit) {
  constexpr int openings = 12;
  std::vector<OperatingPoint> out;
  const double open_m = unit.closed_below_m, end_m = unit.edge.position_m.at(sensor::edge_positions - 1);
  for (int k = 1; k <= openings; ++k) {
    for (const double share : {0.15, 0.4, 0.7, 1.0}) {
      out.push_back(balanced_point(unit, open_m + (end_m - open_m) * k / (openings + 1),
                                   share * unit.edge.highest_pressure_difference_Pa()));
    }
  }
  return out;
}

EffectSlopes effect_slopes(const sensor::ObserverParameters<double>& unit, const std::vector<OperatingPoint>& points,
                           const Eigen::VectorXd& deviation) {
  const Eigen::MatrixXd empty(points.size(), deviating);
  EffectSlopes out{{}, empty, empty, empty, empty};
  for (const OperatingPoint& point : points) out.here.push_back(effects_at(unit, point));
  constexpr double step = 0.2;
  for (Eigen::Index k = 0; k < deviating; ++k) {
    Deviations turned{};
    const double turn = step * std::max(deviation(k), 1e-9);
    turned[k] = turn;
    const sensor::ObserverParameters<double> other = unit_parameters(unit, turned);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const UnitEffects &here = out.here[p], there = effects_at(other, points[p]);
      out.force_N(p, k) = (there.force_N - here.force_N) / turn;
      out.friction_N(p, k) = (there.friction_N - here.friction_N) / turn;
      out.loop_N(p, k) = (there.loop_N - here.loop_N) / turn;
      out.conductance(p, k) = (there.conductance - here.conductance) / turn;
    }
  }
  return out;
}

}  // namespace spoolflow::calibration
