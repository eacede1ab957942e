#pragma once
/// The condensed sensor's maps: as calibrated, and as its step reads them.
#include <type_traits>

#include "spoolflow/sensor/flow_rate.hpp"
#include "spoolflow/sensor/magnetic_force.hpp"
#include "spoolflow/sensor/spring.hpp"

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
  static constexpr int magnetic_force = uncertainty + line;    ///< N: a plane each current cell
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
  [[nodiscard]] constexpr T root_share(int root) const { return T(root) / T(CondensedLayout::root_cells); }
};

template <class T, class ValueAt>
constexpr void put_line(T* to, int cell, const ValueAt& value_at) {
  const T low = value_at(cell);
  const T rise = value_at(cell + 1) - low;
  to[0] = low - T(cell) * rise;
  to[1] = rise;
}

/// `value_at` of the other axis' point and of the position's.
template <class T, class ValueAt>
constexpr void put_plane(T* to, int other, int cell, const ValueAt& value_at) {
  const auto rise_at = [&](int p) { return value_at(other + 1, p) - value_at(other, p); };
  put_line(to, cell, [&](int p) { return value_at(other, p) - T(other) * rise_at(p); });
  put_line(to + CondensedLayout::line, cell, rise_at);
}

}  // namespace detail

/// Lays a calibrated valve out for the step: all maps over the positions of the flow map.
template <class T>
constexpr void lay_out(const CondensedParameters<T>& valve, CondensedTables<T>& out) {
  using Layout = CondensedLayout;
  const Axis<T>& positions = valve.flow_rate.flow_m3_per_s.row_axis;
  const Axis<T>& currents = valve.magnetic_force.map.row_axis;
  const detail::CondensedGrid<T> grid{valve, positions.at(Layout::position_cells) / T(Layout::position_cells),
                                      currents.at(Layout::current_cells) / T(Layout::current_cells)};
  out.cells_per_m = T(1) / grid.cell_m;
  out.cells_per_A = T(1) / grid.cell_A;
  out.closed_below_cells = valve.closed_below_m * out.cells_per_m;
  out.flow_residual_m3_per_s = T(2) * valve.flow_residual_m3_per_s;
  for (int cell = 0; cell < Layout::position_cells; ++cell) {
    T* const record = out.records.data() + Layout::record * cell;
    detail::put_line(record + Layout::spring, cell, [&](int p) { return grid.spring_N(p); });
    detail::put_line(record + Layout::force_per_cells2, cell, [&](int p) { return grid.force_per_cells2_N(p); });
    detail::put_line(record + Layout::uncertainty, cell, [&](int p) { return grid.uncertainty_cells2(p); });
    for (int current = 0; current < Layout::current_cells; ++current) {
      detail::put_plane(record + Layout::magnetic_force + Layout::plane * current, current, cell,
                        [&](int k, int p) { return grid.magnetic_N(k, p); });
    }
    for (int root = 0; root < Layout::root_cells; ++root) {
      T* const flow = record + Layout::flow + Layout::flow_cell * root;
      detail::put_plane(flow, root, cell, [&](int k, int p) {
        return valve.flow_rate.flow_m3_per_s.at(T(p) * grid.cell_m, grid.root_share(k)).value;
      });
      detail::put_plane(flow + Layout::root_pressure, root, cell, [&](int k, int p) {
        return valve.flow_rate.root_pressure_difference.at(T(p) * grid.cell_m, grid.root_share(k)).value;
      });
    }
    for (int k = Layout::flow + Layout::flow_cell * Layout::root_cells; k < Layout::record; ++k) record[k] = T(0);
  }
}

template <class T>
constexpr CondensedTables<T> laid_out(const CondensedParameters<T>& valve) {
  CondensedTables<T> out{};
  lay_out(valve, out);
  return out;
}

}  // namespace spoolflow::sensor
