#pragma once
/// What a sensor's tables answer in the middle of every cell, summed up along each row: a proof that no number of them
/// is wrong and that all are read as they were on the host. The exporter computes the sums in double precision; an
/// exported folder holds this file as it is, and its self-test computes them again on the target.
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::exports {

/// How far a sum may lie from the exported one, as a share of what was summed up: some tens of roundings.
inline constexpr float cell_sum_tolerance = 2e-5F;

/// A row's sum, and the sum of the sizes of what it holds.
template <class T>
struct CellSum {
  T sum{};
  T size{};

  void add(T value) {
    sum += value;
    size += sensor::magnitude(value);
  }
};

template <class T>
T middle(const sensor::Axis<T>& axis, int cell) {
  return axis.at(cell) + axis.spacing / T(2);
}

template <class T, int Points, class Take>
void sum_cells(const sensor::Curve<T, Points>& curve, const Take& take) {
  CellSum<T> row;
  for (int k = 0; k + 1 < Points; ++k) row.add(curve.at(middle(curve.axis, k)).value);
  take(row);
}

template <class T, int Rows, int Columns, class Take>
void sum_cells(const sensor::Map<T, Rows, Columns>& map, const Take& take) {
  for (int r = 0; r + 1 < Rows; ++r) {
    CellSum<T> row;
    for (int c = 0; c + 1 < Columns; ++c) row.add(map.at(middle(map.row_axis, r), middle(map.column_axis, c)).value);
    take(row);
  }
}

template <class T, class Take>
void sum_cells(const sensor::MeteringEdge<T>& edge, const Take& take) {
  for (int layer = 0; layer + 1 < sensor::edge_temperatures; ++layer) {
    for (int r = 0; r + 1 < sensor::edge_pressures; ++r) {
      CellSum<T> force, friction, conductance;
      for (int c = 0; c + 1 < sensor::edge_positions; ++c) {
        const auto point = edge.at(middle(edge.temperature_K, layer), middle(edge.pressure_difference_Pa, r),
                                   middle(edge.position_m, c));
        force.add(point.flow_force_N);
        friction.add(point.friction_N);
        conductance.add(point.conductance);
      }
      take(force), take(friction), take(conductance);
    }
  }
}

/// Every map of the observer, through its own lookups.
template <class T, class Take>
void sum_cells(const sensor::ObserverParameters<T>& valve, sensor::CondensedState<T>& /*state*/, const Take& take) {
  sum_cells(valve.actuator.magnetic_force.map, take);
  sum_cells(valve.actuator.friction_N, take);
  sum_cells(valve.actuator.coil.flux_linkage.map, take);
  sum_cells(valve.spring.curve, take);
  sum_cells(valve.edge, take);
}

/// The condensed sensor through its step: at the middle of each position cell over all currents, so many a cell that
/// the root of the flow force comes through each of its cells. `state` is room for the step.
template <class T, class Take>
void sum_cells(const sensor::CondensedTables<T>& valve, sensor::CondensedState<T>& state, const Take& take) {
  constexpr int currents_a_cell = 8;
  constexpr int currents = currents_a_cell * sensor::CondensedLayout::current_cells;
  for (int p = 0; p < sensor::CondensedLayout::position_cells; ++p) {
    CellSum<T> magnetic_force, spring, flow, width, pressure;
    for (int k = 0; k < currents; ++k) {
      const T current_A = (T(k) + T(0.5)) / (T(currents_a_cell) * valve.cells_per_A);
      const sensor::Sample<T> sample{T(0), current_A, T(0), (T(p) + T(0.5)) / valve.cells_per_m, T(0)};
      const auto& answer = step(valve, state, sample);
      magnetic_force.add(answer.magnetic_force_N);
      spring.add(answer.spring_force_N);
      flow.add(answer.flow_m3_per_s);
      width.add(answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s);
      pressure.add(answer.pressure_difference_Pa);
    }
    take(magnetic_force), take(spring), take(flow), take(width), take(pressure);
  }
}

/// Whether the sums are those of `exported`; `Numbers` has size() and [].
template <class Tables, class Numbers>
bool cells_agree(const Tables& tables, const Numbers& exported) {
  static sensor::CondensedState<float> state;  // on the stack it would be cleared by a call of memset
  decltype(exported.size()) next = 0;
  bool all = true;
  sum_cells(tables, state, [&](const CellSum<float>& row) {
    const float apart = next < exported.size() ? row.sum - exported[next] : row.size;
    ++next;
    all = all && sensor::magnitude(apart) <= cell_sum_tolerance * row.size;  // NaN is wrong, too
  });
  return all && next == exported.size();
}

}  // namespace spoolflow::exports
