#pragma once
/// Curves and maps over equally spaced grid points. Outside the grid they answer at the edge and say so; the slope
/// along an axis that was left is that of the outermost cell. NaN arguments are answered at the first grid point, not
/// inside.
#include <array>

#include "spoolflow/sensor/basis/scalar.hpp"
#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::sensor {

/// Equally spaced grid points of a table: first + k * spacing.
template <class T>
struct Axis {
  T first{};
  T spacing{1};
  T per_spacing{1};  ///< 1 / spacing

  [[nodiscard]] constexpr T at(int k) const { return first + T(k) * spacing; }
};

/// The grid cell that holds a point: `index` of its lower grid point and the share of the cell below the point.
template <class T>
struct Cell {
  int index;
  T share;
};

/// Four neighbours, to be taken at once: their places are `number` to `number + 3`.
template <class T>
constexpr std::array<T, 4> four(const T* from, int number) {
  return {from[number], from[number + 1], from[number + 2], from[number + 3]};
}

/// Two neighbours at once.
template <class T>
constexpr std::array<T, 2> two(const T* from, int number) {
  return {from[number], from[number + 1]};
}

/// How far beyond the end of an axis is still noise and no extrapolation, in cells.
inline constexpr double noise_cells = 0.25;

/// Where a value lies on an axis. `outside()` is called where it lies outside by more than noise at an end.
template <int Points, class T, class Outside>
constexpr Cell<T> locate(const Axis<T>& axis, T value, const Outside& outside) {
  const T raw = (value - axis.first) * axis.per_spacing;
  if (likely(within(raw, T(Points - 1)))) {
    const int index = table_index(raw);
    return {index, raw - T(index)};
  }
  if (raw > T(0)) {
    if (!(raw <= T(Points - 1 + noise_cells))) outside();
    return {Points - 2, T(1)};
  }
  if (!(raw >= T(-noise_cells))) outside();
  return {0, T(0)};
}
template <int Points, class T>
constexpr Cell<T> locate(const Axis<T>& axis, T value) {
  return locate<Points>(axis, value, [] {});
}

/// A point on an axis that begins at zero, counted in cells, with the cell that holds it.
template <class T>
struct Place {
  T cells;
  int index;
};

/// What is this far from an axis, in cells, was not measured.
template <class T>
inline constexpr T wild_cells = T(1 << 30);

/// Where a value lies on an axis of `Cells` cells. Beyond an end it is taken to that end; further than noise, `status`
/// marks it by `beyond`. False, and no place, where the value is NaN or wild.
template <int Cells, class T>
[[nodiscard]] constexpr bool find_place(T cells_per_unit, T value, Status beyond, Place<T>& place, Status& status) {
  place.cells = value * cells_per_unit;
  if (likely(within(place.cells, T(Cells)))) {
    place.index = table_index(place.cells);
    return true;
  }
  // Nearly always it is noise that leaves the axis: asked first.
  if (lies_below(T(0), place.cells)) {
    if (!lies_below(place.cells, T(Cells + noise_cells))) {
      if (!lies_below(place.cells, wild_cells<T>)) return false;
      status |= beyond;
    }
    place = {T(Cells), Cells - 1};
  } else {
    if (!lies_above(place.cells, T(-noise_cells))) {
      if (!lies_above(place.cells, -wild_cells<T>)) return false;
      status |= beyond;
    }
    place = {T(0), 0};
  }
  return true;
}

/// The root of `cells2` on an axis of `Cells` cells. Beyond an end both are taken to that end, and `status` marks it by
/// `beyond`. Not for NaN.
template <int Cells, class T>
constexpr Place<T> root_place(T& cells2, Status beyond, Status& status) {
  if (likely(within(cells2, T(Cells * Cells)))) {
    const T cells = sqrt(cells2);
    return {cells, table_index(cells)};
  }
  status |= beyond;
  const bool above = lies_below(T(0), cells2);
  cells2 = above ? T(Cells * Cells) : T(0);
  return above ? Place<T>{T(Cells), Cells - 1} : Place<T>{T(0), 0};
}

/// What a curve answers.
template <class T>
struct CurvePoint {
  T value;
  T slope;
  bool inside;
};

/// y(x), linear between grid points.
template <class T, int Points>
struct Curve {
  static_assert(Points >= 2);
  static constexpr int points = Points;
  Axis<T> axis;
  Numbers<T, Points> values;

  [[nodiscard]] constexpr CurvePoint<T> at(T x) const {
    bool inside = true;
    const Cell<T> cell = locate<Points>(axis, x, [&] { inside = false; });
    const auto from = values.data() + cell.index;
    const auto [low, high] = two(from, 0);
    const T rise = high - low;
    return {low + cell.share * rise, rise * axis.per_spacing, inside};
  }
};

/// What a map answers.
template <class T>
struct MapPoint {
  T value;
  T row_slope;
  T column_slope;
  bool inside = true;  ///< of cells that is for who located them to say
};

/// z(row, column), bilinear in each cell.
template <class T, int Rows, int Columns>
struct Map {
  static_assert(Rows >= 2 && Columns >= 2);
  static constexpr int rows = Rows;
  static constexpr int columns = Columns;
  Axis<T> row_axis;
  Axis<T> column_axis;
  Numbers<T, Rows * Columns> values;  ///< row after row

  [[nodiscard]] constexpr T& node(int row, int column) { return values[static_cast<unsigned>(row * Columns + column)]; }
  [[nodiscard]] constexpr const T& node(int row, int column) const {
    return values[static_cast<unsigned>(row * Columns + column)];
  }

  [[nodiscard]] constexpr MapPoint<T> at(const Cell<T>& row, const Cell<T>& column) const {
    const auto from = values.data() + row.index * Columns + column.index;
    const auto [low_low, low_high] = two(from, 0);
    const auto [high_low, high_high] = two(from, Columns);
    const T low_rise = low_high - low_low;
    const T high_rise = high_high - high_low;
    const T low = low_low + column.share * low_rise;
    const T high = high_low + column.share * high_rise;
    return {low + row.share * (high - low), (high - low) * row_axis.per_spacing,
            (low_rise + row.share * (high_rise - low_rise)) * column_axis.per_spacing};
  }
  [[nodiscard]] constexpr MapPoint<T> at(T row, T column) const {
    bool inside = true;
    const auto outside = [&] { inside = false; };
    const Cell<T> row_cell = locate<Rows>(row_axis, row, outside),
                  column_cell = locate<Columns>(column_axis, column, outside);
    MapPoint<T> out = at(row_cell, column_cell);
    out.inside = inside;
    return out;
  }
};

/// What a volume answers.
template <class T>
struct VolumePoint {
  T value;
  T row_slope;
};

/// Where a point lies in volumes that share their axes: the cell, and in each of its planes of one row the shares of
/// the four grid points around the line that is crossed.
template <class T>
struct VolumeCell {
  int layer;
  int row;
  int column;
  T lower_left, lower_right, upper_left, upper_right;  ///< of the layer below and above, the column left and right
  T row_share;
  T per_row_spacing;
};

template <class T>
constexpr VolumeCell<T> volume_cell(const Cell<T>& layer, const Cell<T>& row, const Cell<T>& column,
                                    T per_row_spacing) {
  const T upper_right = layer.share * column.share;
  const T lower_right = column.share - upper_right;
  return {
      layer.index, row.index, column.index,   T(1) - layer.share - lower_right, lower_right, layer.share - upper_right,
      upper_right, row.share, per_row_spacing};
}

/// z(layer, row, column), trilinear in each cell. The three axes stand beside it, for volumes that share them. All
/// layers of a grid point lie together, so that one address reaches the whole cell.
template <class T, int Layers, int Rows, int Columns>
struct Volume {
  static_assert(Layers >= 2 && Rows >= 2 && Columns >= 2);
  Numbers<T, Layers * Rows * Columns> values;  ///< row after row, column after column, layer after layer

  [[nodiscard]] constexpr T& node(int layer, int row, int column) {
    return values[static_cast<unsigned>((row * Columns + column) * Layers + layer)];
  }
  [[nodiscard]] constexpr const T& node(int layer, int row, int column) const {
    return values[static_cast<unsigned>((row * Columns + column) * Layers + layer)];
  }
  [[nodiscard]] constexpr VolumePoint<T> at(const VolumeCell<T>& cell) const {
    const auto place = values.data() + (cell.row * Columns + cell.column) * Layers + cell.layer;
    const auto between = [&](int from) {
      const auto [low_left, high_left] = two(place, from);
      const auto [low_right, high_right] = two(place, from + Layers);
      return cell.lower_left * low_left + cell.lower_right * low_right + cell.upper_left * high_left +
             cell.upper_right * high_right;
    };
    const T low = between(0);
    const T rise = between(Layers * Columns) - low;
    return {low + cell.row_share * rise, rise * cell.per_row_spacing};
  }
};

}  // namespace spoolflow::sensor
