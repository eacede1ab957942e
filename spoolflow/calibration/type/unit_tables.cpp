#include "spoolflow/calibration/type/unit_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace spoolflow::calibration {
namespace {

using Parameters = sensor::ObserverParameters<double>;

/// One standard deviation of what a campaign's fit leaves of a table.
constexpr double spring_N = 0.1, magnetic_force_N = 0.4, flow_force_N = 0.25;
constexpr double flux_share = 0.01, loop_share = 0.05, resistance_share = 0.005, flow_share = 0.007,
                 friction_share = 0.1;
/// Rows of a table that count as measured apart.
constexpr double rows_apart = 6;
constexpr std::array<double, 9> places{0.08, 0.18, 0.28, 0.39, 0.5, 0.61, 0.72, 0.83, 0.94};
constexpr std::array<double, 4> shares_of_current{0.3, 0.5, 0.7, 0.9}, shares_of_pressure{0.25, 0.5, 0.75, 1};
constexpr std::array<double, 4> balanced_at{0, 0.33, 0.67, 1};  ///< shares of the highest pressure

struct Newtons {
  std::optional<double> balance_N;              ///< see TableComparison
  const std::vector<OperatingPoint>& balanced;  ///< where the base's forces balance
  double scale;                                 ///< the unit's newton in that of the base
};

/// Rows of tables, one after the other.
struct Rows {
  std::vector<double> values;
  std::vector<Eigen::Index> ends;
  void add(double value, double deviation) { values.push_back(value / deviation); }
  void end_table() { ends.push_back(static_cast<Eigen::Index>(values.size())); }
};

std::vector<double> positions_of(const Parameters& base) {
  const double begin_m = base.edge.position_m.first, end_m = base.edge.position_m.at(sensor::edge_positions - 1);
  std::vector<double> out;
  for (const double place : places) out.push_back(begin_m + place * (end_m - begin_m));
  return out;
}

/// Forces as force rigs measured them, each by itself.
void add_measured_forces(Rows& rows, const Parameters& unit, const Parameters& base,
                         const std::vector<double>& positions_m) {
  for (const double position_m : positions_m) rows.add(unit.spring.at(position_m).value, spring_N);
  rows.end_table();
  for (const double share : shares_of_current) {
    for (const double position_m : positions_m)
      rows.add(unit.actuator.magnetic_force.at(share * base.largest_current_A, position_m).value, magnetic_force_N);
  }
  rows.end_table();
}

/// What a flow bench sees of forces: what is left of the unit's, in the newtons of the base, where the base's balance.
void add_balances(Rows& rows, const Parameters& unit, const Newtons& newtons) {
  for (const OperatingPoint& point : newtons.balanced)
    rows.add(effects_at(unit, point).force_N / newtons.scale, *newtons.balance_N);
  rows.end_table();
}

void add_coil(Rows& rows, const Parameters& unit, const Parameters& base, const std::vector<double>& positions_m,
              double scale) {
  const sensor::ActuatorParameters<double>&of = unit.actuator, &beside = base.actuator;
  const double largest_A = base.largest_current_A;
  const double flux_Wb = beside.coil.flux_linkage.map.at(largest_A, positions_m.front()).value;
  for (const double share : shares_of_current) {
    for (const double position_m : positions_m)
      rows.add(of.coil.flux_linkage.map.at(share * largest_A, position_m).value, flux_share * flux_Wb);
  }
  rows.end_table();
  rows.add(of.coercive_current_A, loop_share * std::max(beside.coercive_current_A, 1e-6));
  rows.end_table();
  rows.add(of.coil_resistance.resistance_Ohm, resistance_share * std::max(beside.coil_resistance.resistance_Ohm, 1e-6));
  rows.end_table();
  for (const double share : shares_of_current) {
    const double position_m = positions_m[positions_m.size() / 2];
    rows.add(of.friction_N.at(share * largest_A, position_m).value / scale,
             friction_share * std::max(beside.friction_N.at(share * largest_A, position_m).value, 0.02));
  }
  rows.end_table();
}

void add_edge(Rows& rows, const Parameters& unit, const Parameters& base, const std::vector<double>& positions_m,
              const Newtons& newtons) {
  const double temperature_K = base.edge.temperature_K.at(1), highest_Pa = base.edge.highest_pressure_difference_Pa();
  const double widest = base.edge.at(temperature_K, highest_Pa, positions_m.back()).conductance;
  std::vector<sensor::EdgePoint<double>> points;
  for (const double share : shares_of_pressure) {
    for (const double position_m : positions_m)
      points.push_back(unit.edge.at(temperature_K, share * highest_Pa, position_m));
  }
  for (const auto& point : points) rows.add(point.conductance, flow_share * widest);
  rows.end_table();
  if (!newtons.balance_N) {
    for (const auto& point : points) rows.add(point.flow_force_N, flow_force_N);
    rows.end_table();
  }
  for (const double share : {0.0, 1.0}) {
    for (const double position_m : positions_m) {
      rows.add(unit.edge.at(temperature_K, share * highest_Pa, position_m).friction_N / newtons.scale,
               friction_share * std::max(base.edge.at(temperature_K, share * highest_Pa, position_m).friction_N, 0.05));
    }
  }
  rows.end_table();
}

/// All tables of `unit`, at the points and over the scales of `base`.
Rows rows_of(const Parameters& unit, const Parameters& base, const Newtons& newtons) {
  const std::vector<double> positions_m = positions_of(base);
  Rows rows;
  if (newtons.balance_N) {
    add_balances(rows, unit, newtons);
  } else {
    add_measured_forces(rows, unit, base, positions_m);
  }
  add_coil(rows, unit, base, positions_m, newtons.scale);
  add_edge(rows, unit, base, positions_m, newtons);
  return rows;
}

std::vector<OperatingPoint> balanced_points(const Parameters& base) {
  const double highest_Pa = base.edge.highest_pressure_difference_Pa();
  std::vector<OperatingPoint> out;
  for (const double share : balanced_at) {
    for (const double position_m : positions_of(base))
      out.push_back(balanced_point(base, position_m, share * highest_Pa));
  }
  return out;
}

/// The newton of `unit` in that of `base`: magnetic forces where those of `base` balance differ by a few percent
/// between units of a type.
double scale_between(const Parameters& base, const Parameters& unit, const std::vector<OperatingPoint>& balanced) {
  double of_unit_N = 0, of_base_N = 0;
  for (const OperatingPoint& point : balanced) {
    of_unit_N += unit.actuator.magnetic_force.at(point.current_A, point.position_m).value;
    of_base_N += base.actuator.magnetic_force.at(point.current_A, point.position_m).value;
  }
  return of_unit_N > 0 && of_base_N > 0 ? of_unit_N / of_base_N : 1;
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

TableComparison::TableComparison(const Parameters& base, const Parameters& unit, std::optional<double> balance_N)
    : base_(base), unit_(unit), balance_N_(balance_N) {
  if (balance_N) balanced_ = balanced_points(base);
  Rows rows = rows_of(unit, base, {balance_N, balanced_, balance_N ? scale_between(base, unit, balanced_) : 1});
  of_unit_ = vector_of(rows.values);
  ends_ = std::move(rows.ends);
}

Eigen::VectorXd TableComparison::rows(const Deviations& deviations) const {
  return vector_of(rows_of(unit_parameters(base_, deviations), base_, {balance_N_, balanced_, 1}).values) - of_unit_;
}

Eigen::VectorXd TableComparison::weights(const Eigen::VectorXd& left) const {
  Eigen::VectorXd out(left.size());
  Eigen::Index begin = 0;
  for (const Eigen::Index end : ends_) {
    const double count = static_cast<double>(end - begin),
                 mean_square = left.segment(begin, end - begin).squaredNorm() / count;
    out.segment(begin, end - begin).setConstant(std::min(1.0, rows_apart / count) / std::max(1.0, mean_square));
    begin = end;
  }
  return out;
}

double TableComparison::force_left_N(const Deviations& deviations) const {
  const Parameters other = unit_parameters(base_, deviations);
  const std::vector<OperatingPoint> points = operating_points(unit_);
  double sum = 0;
  for (const OperatingPoint& point : points)
    sum += std::pow(effects_at(other, point).force_N - effects_at(unit_, point).force_N, 2);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace spoolflow::calibration
