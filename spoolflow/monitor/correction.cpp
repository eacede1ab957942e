#include "spoolflow/monitor/correction.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::monitor {
namespace {

void scale(sensor::Axis<double>& axis, double factor) {
  axis.first *= factor;
  axis.spacing *= factor;
  axis.per_spacing /= factor;
}

template <class Values>
void scale_all(Values& values, double factor) {
  for (double& value : values) value *= factor;
}

void weaken(sensor::Spring<double>& spring, const Difference& difference, double stroke_m) {
  const sensor::Axis<double>& axis = spring.curve.axis;
  const double closed_m = axis.first;
  const double preload_N = spring.at(closed_m).value;
  const double rate_N = spring.at(closed_m + stroke_m).value - preload_N;
  for (int k = 0; k < sensor::spring_positions; ++k) {
    const double way = (axis.at(k) - closed_m) / stroke_m;
    spring.curve.values[static_cast<std::size_t>(k)] -=
        difference.preload_loss * preload_N + difference.rate_loss * rate_N * way;
  }
}

/// Force and its loop over the coil's own ampere-turns.
void short_turns(sensor::MagneticForce<double>& force, double left) {
  scale(force.map.row_axis, 1 / left);
  scale(force.hysteresis_half_width_N.axis, 1 / left);
}

void short_turns(sensor::ActuatorParameters<double>& actuator, double shorted) {
  const double left = 1 - shorted;
  short_turns(actuator.magnetic_force, left);
  scale(actuator.friction_N.row_axis, 1 / left);
  sensor::Coil<double>& coil = actuator.coil;
  scale(coil.flux_linkage.map.row_axis, 1 / left);
  scale_all(coil.flux_linkage.map.values, left);
  sensor::MagneticHysteresis<double>& hysteresis = coil.hysteresis;
  scale_all(hysteresis.threshold, left);
  scale_all(hysteresis.stiffness, 1 / (left * left));
  scale_all(hysteresis.stiffness_increase, 1 / (left * left));
  hysteresis.per_full_flux /= left;
  sensor::EddyCurrents<double>& eddy = coil.eddy_currents;
  eddy.classical_A_per_V /= left * left;
  eddy.excess_A_per_rootV /= left * std::sqrt(left);
  eddy.smallest_rate_V *= left;
  sensor::CoilResistance<double>& resistance = actuator.coil_resistance;
  if (resistance.resistance_Ohm > 0) eddy.classical_A_per_V += shorted / (left * left * resistance.resistance_Ohm);
  resistance.resistance_Ohm *= left;
  actuator.coercive_current_A /= left;
  actuator.current_uncertainty_A /= left;
  actuator.per_wiping_flux /= left;
}

/// The curve's values at positions `shift_m` lower; beyond its first point by `slope_share` of the outermost slope.
template <int Points>
void shift(sensor::Curve<double, Points>& curve, double shift_m, double slope_share) {
  const sensor::Curve<double, Points> before = curve;
  for (int k = 0; k < Points; ++k) {
    const double at = before.axis.at(k) - shift_m;
    const double kept = std::clamp(at, before.axis.first, before.axis.at(Points - 1));
    const sensor::CurvePoint<double> point = before.at(kept);
    curve.values[static_cast<std::size_t>(k)] = point.value + slope_share * point.slope * (at - kept);
  }
}

template <int Rows, int Columns>
void shift_columns(sensor::Map<double, Rows, Columns>& map, double shift_m) {
  const sensor::Map<double, Rows, Columns> before = map;
  for (int r = 0; r < Rows; ++r) {
    for (int c = 0; c < Columns; ++c) {
      const double at = before.column_axis.at(c) - shift_m;
      const double kept = std::clamp(at, before.column_axis.first, before.column_axis.at(Columns - 1));
      const sensor::MapPoint<double> point = before.at(before.row_axis.at(r), kept);
      map.node(r, c) = point.value + point.column_slope * (at - kept);
    }
  }
}

template <int Rows, int Columns>
void shift_rows(sensor::Map<double, Rows, Columns>& map, double shift_m) {
  const sensor::Map<double, Rows, Columns> before = map;
  for (int r = 0; r < Rows; ++r) {
    const double at = std::clamp(before.row_axis.at(r) - shift_m, before.row_axis.first, before.row_axis.at(Rows - 1));
    for (int c = 0; c < Columns; ++c) map.node(r, c) = before.at(at, before.column_axis.at(c)).value;
  }
}

}  // namespace

void apply(const Difference& difference, double stroke_m, sensor::ObserverParameters<double>& valve) {
  scale_all(valve.edge.friction_N.values, difference.friction_ratio);
  scale_all(valve.actuator.friction_N.values, difference.friction_ratio);
  valve.friction.tolerance_N *= difference.friction_ratio;
  weaken(valve.spring, difference, stroke_m);
  if (difference.shorted_turns > 0) short_turns(valve.actuator, difference.shorted_turns);
  const double zero_m = difference.position_zero_m;
  for (sensor::Axis<double>* axis :
       {&valve.actuator.magnetic_force.map.column_axis, &valve.actuator.friction_N.column_axis,
        &valve.actuator.coil.flux_linkage.map.column_axis, &valve.spring.curve.axis, &valve.edge.position_m})
    axis->first += zero_m;
  valve.closed_below_m += zero_m;
  valve.stopped_above_m += zero_m;
}

void apply(const Difference& difference, double stroke_m, sensor::CondensedParameters<double>& valve) {
  scale_all(valve.friction_half_width_N.values, difference.friction_ratio);
  weaken(valve.spring, difference, stroke_m);
  if (difference.shorted_turns > 0) short_turns(valve.magnetic_force, 1 - difference.shorted_turns);
  const double zero_m = difference.position_zero_m;
  if (zero_m == 0) return;
  shift(valve.spring.curve, zero_m, 1);
  shift(valve.friction_half_width_N, zero_m, 0);
  shift(valve.flow_rate.largest_force_N, zero_m, 0);
  shift_columns(valve.magnetic_force.map, zero_m);
  shift_rows(valve.flow_rate.flow_m3_per_s, zero_m);
  shift_rows(valve.flow_rate.root_pressure_difference, zero_m);
  valve.closed_below_m += zero_m;
}

}  // namespace spoolflow::monitor
