#include "spoolflow/calibration/type/unit_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spoolflow::calibration {
namespace {

using sensor::Axis;

void scale_axis(Axis<double>& axis, double factor) {
  axis.first *= factor;
  axis.spacing *= factor;
  axis.per_spacing /= factor;
}

/// Positions as the unit's own sensor reads them.
void read_axis(Axis<double>& position_m, const Deviations& p) {
  scale_axis(position_m, 1 + p[at(Variation::position_gain)]);
  position_m.first += p[at(Variation::position_zero)];
}

template <class Values>
void scale(Values& values, double factor) {
  for (double& value : values) value *= factor;
}

/// A point on an axis, for lines through its two neighbours that go on beyond both ends.
struct Between {
  int index;
  double share;
};
Between between(const Axis<double>& axis, int points, double value) {
  double raw = (value - axis.first) * axis.per_spacing;
  constexpr double rounding = 1e-9;  // of a grid point that was not moved
  if (std::abs(raw - std::round(raw)) < rounding) raw = std::round(raw);
  const int index = std::clamp(static_cast<int>(std::floor(raw)), 0, points - 2);
  return {index, raw - index};
}

/// `value(k)` on the line through two grid points.
template <class Value>
double on_line(const Between& place, const Value& value) {
  const double low = value(place.index);
  return low + place.share * (value(place.index + 1) - low);
}

/// Flow force of the unit over the type's, along the opening: width, jet and its tilt.
double flow_force_factor(const Deviations& p, double opening_share) {
  return (1 + p[at(Variation::edge_width)]) *
         (1 + p[at(Variation::flow_force)] + p[at(Variation::flow_force_tilt)] * (2 * opening_share - 1));
}

/// Where the type has what the unit has at column k.
Between before_shift(const Axis<double>& position_m, int points, int k, const Deviations& p) {
  return between(position_m, points, position_m.at(k) - p[at(Variation::edge_position)]);
}

void vary_spring(sensor::Spring<double>& spring, const Deviations& p) {
  auto& forces_N = spring.curve.values;
  const double closed_N = forces_N.front();
  const double mean_N = std::accumulate(forces_N.begin(), forces_N.end(), 0.0) / sensor::spring_positions;
  for (double& force_N : forces_N)
    force_N += p[at(Variation::spring_preload)] * mean_N + p[at(Variation::spring_rate)] * (force_N - closed_N);
  read_axis(spring.curve.axis, p);
}

void vary_edge(sensor::MeteringEdge<double>& edge, const Deviations& p) {
  const sensor::MeteringEdge<double> type = edge;
  constexpr int columns = sensor::edge_positions;
  for (int column = 0; column < columns; ++column) {
    const Between from = before_shift(type.position_m, columns, column, p);
    const double force_factor = flow_force_factor(p, static_cast<double>(column) / (columns - 1));
    for (int layer = 0; layer < sensor::edge_temperatures; ++layer) {
      const double bare_N = type.friction_N.node(layer, 0, column);
      for (int row = 0; row < sensor::edge_pressures; ++row) {
        edge.conductance.node(layer, row, column) = (1 + p[at(Variation::edge_width)]) * on_line(from, [&](int k) {
                                                      return type.conductance.node(layer, row, k);
                                                    });
        edge.flow_force_N.node(layer, row, column) =
            force_factor * on_line(from, [&](int k) { return type.flow_force_N.node(layer, row, k); });
        edge.friction_N.node(layer, row, column) = std::max(
            0.0, (1 + p[at(Variation::spool_friction)]) * bare_N +
                     (1 + p[at(Variation::pressure_friction)]) * (type.friction_N.node(layer, row, column) - bare_N));
      }
    }
  }
  read_axis(edge.position_m, p);
}

/// The current, on the type's map of flux linkage, that has the flux which the unit has at `current_A`: its air gap
/// asks for less or more of the ampere turns.
double same_flux_A(const sensor::FluxLinkage<double>& flux, double current_A, double position_m, double share) {
  const auto& map = flux.map;
  double gap_Wb_per_A = 0;
  for (int row = 0; row < sensor::flux_map_currents; ++row) {
    const double at_A = map.row_axis.at(row);
    if (at_A > 0) gap_Wb_per_A = std::max(gap_Wb_per_A, map.at(at_A, position_m).value / at_A);
  }
  if (!(gap_Wb_per_A > 0)) return current_A;
  double out_A = current_A;
  constexpr int rounds = 4;  // each leaves a share of the last error as small as the deviation
  for (int round = 0; round < rounds; ++round) {
    const sensor::MapPoint<double> here = map.at(out_A, position_m);
    const double beyond_A =
        out_A - std::clamp(out_A, map.row_axis.first, map.row_axis.at(sensor::flux_map_currents - 1));
    out_A = current_A + share * (here.value + here.row_slope * beyond_A) / gap_Wb_per_A;
  }
  return out_A;
}

/// Moves a map over current so that each point has what the type has at the same flux.
template <class Map>
void move_currents(Map& map, const sensor::FluxLinkage<double>& flux, double share) {
  const Map type = map;
  for (int row = 0; row < Map::rows; ++row) {
    for (int column = 0; column < Map::columns; ++column) {
      const double current_A = same_flux_A(flux, type.row_axis.at(row), type.column_axis.at(column), share);
      map.node(row, column) =
          on_line(between(type.row_axis, Map::rows, current_A), [&](int k) { return type.node(k, column); });
    }
  }
}

void vary_permeance(sensor::ActuatorParameters<double>& actuator, const Deviations& p) {
  const double permeance = p[at(Variation::permeance)];
  if (permeance == 0) return;
  const double share = permeance / (1 + permeance);
  const sensor::FluxLinkage<double> type = actuator.coil.flux_linkage;
  move_currents(actuator.magnetic_force.map, type, share);
  move_currents(actuator.coil.flux_linkage.map, type, share);
  scale(actuator.magnetic_force.map.values, 1 / (1 + permeance));
}

void vary_turns(sensor::ActuatorParameters<double>& actuator, double turns) {
  for (Axis<double>* axis :
       {&actuator.magnetic_force.map.row_axis, &actuator.magnetic_force.hysteresis_half_width_N.axis,
        &actuator.friction_N.row_axis, &actuator.coil.flux_linkage.map.row_axis})
    scale_axis(*axis, 1 / turns);
  sensor::MagneticHysteresis<double>& hysteresis = actuator.coil.hysteresis;
  scale(actuator.coil.flux_linkage.map.values, turns);
  scale(hysteresis.threshold, turns);
  scale(hysteresis.stiffness, 1 / (turns * turns));
  scale(hysteresis.stiffness_increase, 1 / (turns * turns));
  hysteresis.per_full_flux /= turns;
  sensor::EddyCurrents<double>& eddy = actuator.coil.eddy_currents;
  eddy.classical_A_per_V /= turns * turns;
  eddy.excess_A_per_rootV /= turns * std::sqrt(turns);
  eddy.smallest_rate_V *= turns;
  actuator.coercive_current_A /= turns;
  actuator.per_wiping_flux /= turns;
}

void vary_actuator(sensor::ActuatorParameters<double>& actuator, const Deviations& p) {
  vary_permeance(actuator, p);
  vary_turns(actuator, 1 + p[at(Variation::turns)]);
  const double coercivity = 1 + p[at(Variation::coercivity)];
  scale(actuator.coil.hysteresis.stiffness, coercivity);
  scale(actuator.coil.hysteresis.stiffness_increase, coercivity);
  scale(actuator.magnetic_force.hysteresis_half_width_N.values, coercivity);
  actuator.coercive_current_A *= coercivity;
  scale(actuator.friction_N.values, 1 + p[at(Variation::armature_friction)]);
  actuator.coil_resistance.resistance_Ohm *= 1 + p[at(Variation::resistance)];
  for (Axis<double>* axis : {&actuator.magnetic_force.map.column_axis, &actuator.friction_N.column_axis,
                             &actuator.coil.flux_linkage.map.column_axis})
    read_axis(*axis, p);
}

void vary_flow_rate(sensor::FlowRate<double>& flow_rate, const Deviations& p) {
  const sensor::FlowRate<double> type = flow_rate;
  constexpr int points = sensor::flow_map_positions;
  for (int k = 0; k < points; ++k) {
    Between from = before_shift(type.largest_force_N.axis, points, k, p);
    from.share = std::clamp(from.share, 0.0, 1.0);  // flow must not fall with force, as a line beyond an end may
    const auto force_N = [&](int j) { return type.largest_force_N.values[static_cast<unsigned>(j)]; };
    flow_rate.largest_force_N.values[static_cast<unsigned>(k)] =
        flow_force_factor(p, static_cast<double>(k) / (points - 1)) * on_line(from, force_N);
    for (int share = 0; share < sensor::flow_map_forces; ++share) {
      flow_rate.flow_m3_per_s.node(k, share) =
          (1 + p[at(Variation::edge_width)]) * on_line(from, [&](int j) { return type.flow_m3_per_s.node(j, share); });
      flow_rate.root_pressure_difference.node(k, share) =
          on_line(from, [&](int j) { return type.root_pressure_difference.node(j, share); });
    }
  }
  for (Axis<double>* axis : {&flow_rate.largest_force_N.axis, &flow_rate.flow_m3_per_s.row_axis,
                             &flow_rate.root_pressure_difference.row_axis})
    read_axis(*axis, p);
}

/// What the unit's position sensor shows where that of the type shows `type_m`.
double shown_m(double type_m, const Deviations& p) {
  return type_m * (1 + p[at(Variation::position_gain)]) + p[at(Variation::position_zero)];
}

double closed_below(double type_m, const Deviations& p) {
  return shown_m(type_m + p[at(Variation::edge_position)], p);
}

}  // namespace

sensor::ObserverParameters<double> unit_parameters(const sensor::ObserverParameters<double>& type,
                                                   const Deviations& deviations) {
  sensor::ObserverParameters<double> out = type;
  vary_actuator(out.actuator, deviations);
  vary_spring(out.spring, deviations);
  vary_edge(out.edge, deviations);
  out.friction.ageing_s *= std::exp(deviations[at(Variation::ageing_time)]);
  out.closed_below_m = closed_below(type.closed_below_m, deviations);
  out.stopped_above_m = shown_m(type.stopped_above_m, deviations);
  return out;
}

sensor::CondensedParameters<double> unit_parameters(const sensor::CondensedParameters<double>& type,
                                                    const Deviations& deviations) {
  sensor::CondensedParameters<double> out = type;
  sensor::MagneticForce<double>& magnetic = out.magnetic_force;
  scale(magnetic.map.values, 1 + deviations[at(Variation::permeance)]);
  scale(magnetic.hysteresis_half_width_N.values, 1 + deviations[at(Variation::coercivity)]);
  for (Axis<double>* axis : {&magnetic.map.row_axis, &magnetic.hysteresis_half_width_N.axis})
    scale_axis(*axis, 1 / (1 + deviations[at(Variation::turns)]));
  read_axis(magnetic.map.column_axis, deviations);
  vary_spring(out.spring, deviations);
  scale(out.friction_half_width_N.values, 1 + deviations[at(Variation::spool_friction)]);
  read_axis(out.friction_half_width_N.axis, deviations);
  vary_flow_rate(out.flow_rate, deviations);
  out.closed_below_m = closed_below(type.closed_below_m, deviations);
  return out;
}

}  // namespace spoolflow::calibration
