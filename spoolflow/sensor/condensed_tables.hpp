#pragma once
/// The condensed sensor's maps: as calibrated, and as its step reads them.
#include <type_traits>

#include "spoolflow/sensor/flow_rate.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::sensor {

/// Everything about one valve that the condensed sensor needs, as calibrated. All axes begin at zero or above.
template <class T>
struct CondensedParameters {
  MagneticForce<T> magnetic_force;
  Spring<T> spring;
  FlowRate<T> flow_rate;
  Curve<T, spring_positions> friction_half_width_N;  ///< over position [m]: what averaging both directions removed
  T closed_below_m{};                                ///< positions at which no flow was measured
  T force_residual_N{};                              ///< standard deviation of the averaged forces about the maps
  T flow_residual_m3_per_s{};                        ///< standard deviation of the measured flow about the map
};

/// What lies where in the record that each position cell has. A line is two numbers: its value at position zero and its
/// rise a cell. A plane is two lines: at zero of its other axis, and their rise a cell of that. All axes begin at zero
/// and are counted in cells, so that a step takes no shares of cells and no differences of neighbours.
struct CondensedLayout {
  static constexpr int position_cells = flow_map_positions - 1;
  static constexpr int current_cells = force_map_currents - 1;
  static constexpr int root_cells = 8;  ///< flow is nearly linear in the root of the force: half the map's cells do

  static constexpr int line = 2;
  static constexpr int plane = 2 * line;
  static constexpr int spring = 0;                             ///< N
  static constexpr int force_per_cells2 = spring + line;       ///< N: the largest flow force over root_cells squared
  static constexpr int uncertainty = force_per_cells2 + line;  ///< of the flow force, over force_per_cells2
  static constexpr int spare = uncertainty + line;             ///< so that all that follows lies in fours
  static constexpr int magnetic_force = spare + line;          ///< N: a plane each current cell
  static constexpr int flow = magnetic_force + plane * current_cells;  ///< each root cell m3/s, and then
  static constexpr int root_pressure = plane;                          ///< sqrt(Pa)
  static constexpr int flow_cell = 2 * plane;
  static constexpr int record = 256;  ///< a power of two: the record is found by a shift
};
static_assert(CondensedLayout::flow + CondensedLayout::flow_cell * CondensedLayout::root_cells <=
              CondensedLayout::record);

/// The same valve, laid out for the step; trivially copyable, fit for constexpr flash.
template <class T>
struct CondensedTables {
  T cells_per_m{};
  T cells_per_A{};
  T closed_below_cells{};
  T flow_residual_m3_per_s{};  ///< two standard deviations
  Numbers<T, CondensedLayout::record * CondensedLayout::position_cells> records;
};

static_assert(std::is_trivially_copyable_v<CondensedParameters<float>>);
static_assert(std::is_trivially_copyable_v<CondensedTables<float>>);

namespace detail {

/// A calibrated valve, read at the positions between which the records lie.
template <class T>
struct CondensedGrid {
  const CondensedParameters<T>& valve;
  T cell_m;
  T cell_A;

  [[nodiscard]] constexpr T spring_N(int p) const { return valve.spring.at(T(p) * cell_m).value; }
  [[nodiscard]] constexpr T magnetic_N(int current, int p) const {
    return valve.magnetic_force.at(T(current) * cell_A, T(p) * cell_m).value;
  }
  [[nodiscard]] constexpr T force_per_cells2_N(int p) const {
    constexpr int most = CondensedLayout::root_cells * CondensedLayout::root_cells;
    return valve.flow_rate.largest_force_N.at(T(p) * cell_m).value / T(most);
  }
  /// Friction and hysteresis are bounds, the residual is random: the first add, the second is covered twice over.
  /// Hysteresis grows with the current: taken where the magnetic force holds the largest flow force of this position.
  [[nodiscard]] constexpr T uncertainty_cells2(int p) const {
    const T largest_N = spring_N(p) + valve.flow_rate.largest_force_N.at(T(p) * cell_m).value;
    int current = 0;
    while (current < CondensedLayout::current_cells && magnetic_N(current, p) < largest_N) ++current;
    const T hysteresis_N = valve.magnetic_force.hysteresis_half_width_N.at(T(current) * cell_A).value;
    return (valve.friction_half_width_N.at(T(p) * cell_m).value + hysteresis_N + T(2) * valve.force_residual_N) /
           force_per_cells2_N(p);
  }
};

/// The line through the values at both ends of a position cell.
template <class T>
constexpr void put_line(T* to, int cell, T low, T high) {
  to[1] = high - low;
  to[0] = low - T(cell) * to[1];
}

/// The same of what is never negative, as it is evaluated in single precision, too: the line begins and ends no lower
/// than what rounding may take away.
template <class T>
constexpr void put_positive_line(T* to, int cell, T low, T high) {
  const T rounding = T(2e-7) * T(CondensedLayout::position_cells);
  put_line(to, cell, larger(low, rounding * high), larger(high, rounding * low));
}

/// The plane through `value_at` the four corners of a cell of the other axis and a position cell.
template <class T, class ValueAt>
constexpr void put_plane(T* to, int other, int cell, const ValueAt& value_at) {
  const T near[] = {value_at(other, cell), value_at(other, cell + 1)};
  const T rise[] = {value_at(other + 1, cell) - near[0], value_at(other + 1, cell + 1) - near[1]};
  put_line(to, cell, near[0] - T(other) * rise[0], near[1] - T(other) * rise[1]);
  put_line(to + CondensedLayout::line, cell, rise[0], rise[1]);
}

/// The same of what never falls along the other axis.
template <class T, class ValueAt>
constexpr void put_rising_plane(T* to, int other, int cell, const ValueAt& value_at) {
  put_plane(to, other, cell, value_at);
  T* const rise = to + CondensedLayout::line;
  const T low = value_at(other + 1, cell) - value_at(other, cell);
  const T high = value_at(other + 1, cell + 1) - value_at(other, cell + 1);
  put_positive_line(rise, cell, low, high);
}

template <class T>
constexpr CondensedGrid<T> grid_of(const CondensedParameters<T>& valve) {
  using Layout = CondensedLayout;
  return {valve, valve.flow_rate.flow_m3_per_s.row_axis.at(Layout::position_cells) / T(Layout::position_cells),
          valve.magnetic_force.map.row_axis.at(Layout::current_cells) / T(Layout::current_cells)};
}

template <class T>
constexpr void put_scales(const CondensedGrid<T>& grid, CondensedTables<T>& out) {
  out.cells_per_m = T(1) / grid.cell_m;
  out.cells_per_A = T(1) / grid.cell_A;
  out.closed_below_cells = grid.valve.closed_below_m * out.cells_per_m;
  out.flow_residual_m3_per_s = T(2) * grid.valve.flow_residual_m3_per_s;
}

template <class T>
constexpr void put_record(const CondensedGrid<T>& grid, int cell, T* record) {
  using Layout = CondensedLayout;
  const auto& flow_rate = grid.valve.flow_rate;
  put_line(record + Layout::spring, cell, grid.spring_N(cell), grid.spring_N(cell + 1));
  put_line(record + Layout::force_per_cells2, cell, grid.force_per_cells2_N(cell), grid.force_per_cells2_N(cell + 1));
  put_positive_line(record + Layout::uncertainty, cell, grid.uncertainty_cells2(cell),
                    grid.uncertainty_cells2(cell + 1));
  put_line(record + Layout::spare, cell, T(0), T(0));
  for (int current = 0; current < Layout::current_cells; ++current) {
    put_plane(record + Layout::magnetic_force + Layout::plane * current, current, cell,
              [&](int k, int p) { return grid.magnetic_N(k, p); });
  }
  for (int root = 0; root < Layout::root_cells; ++root) {
    T* const flow = record + Layout::flow + Layout::flow_cell * root;
    const auto share = [](int k) { return T(k) / T(Layout::root_cells); };
    put_rising_plane(flow, root, cell,
                     [&](int k, int p) { return flow_rate.flow_m3_per_s.at(T(p) * grid.cell_m, share(k)).value; });
    put_plane(flow + Layout::root_pressure, root, cell,
              [&](int k, int p) { return flow_rate.root_pressure_difference.at(T(p) * grid.cell_m, share(k)).value; });
  }
  for (int k = Layout::flow + Layout::flow_cell * Layout::root_cells; k < Layout::record; ++k) record[k] = T(0);
}

}  // namespace detail

/// Lays a calibrated valve out for the step: all maps over the positions of the flow map.
template <class T>
constexpr void lay_out(const CondensedParameters<T>& valve, CondensedTables<T>& out) {
  const auto grid = detail::grid_of(valve);
  detail::put_scales(grid, out);
  for (int cell = 0; cell < CondensedLayout::position_cells; ++cell)
    detail::put_record(grid, cell, out.records.data() + CondensedLayout::record * cell);
}

/// Only what a step at this position reads; for tools that change the valve before each step.
template <class T>
constexpr void lay_out_at(const CondensedParameters<T>& valve, T position_m, CondensedTables<T>& out) {
  const auto grid = detail::grid_of(valve);
  detail::put_scales(grid, out);
  const T cells = position_m * out.cells_per_m;
  const int cell = table_index(cells > T(0) ? smaller(cells, T(CondensedLayout::position_cells - 1)) : T(0));
  detail::put_record(grid, cell, out.records.data() + CondensedLayout::record * cell);
}

template <class T>
constexpr CondensedTables<T> laid_out(const CondensedParameters<T>& valve) {
  CondensedTables<T> out{};
  lay_out(valve, out);
  return out;
}

}  // namespace spoolflow::sensor
