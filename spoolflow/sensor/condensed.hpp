#pragma once
/// The paper's condensed sensor (section 3, Fig 4): two averaged maps and the springs.
#include <type_traits>

#include "spoolflow/sensor/condensed_tables.hpp"
#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::sensor {

/// The condensed sensor remembers only its last answer, which it holds where a sample is missing.
template <class T>
struct CondensedState {
  Estimate<T> last{};
};

static_assert(std::is_trivially_copyable_v<CondensedState<float>>);

namespace detail {

/// A point in the tables, and what is told of it.
template <class T>
struct CondensedPoint {
  Place<T> position;
  Place<T> current;
  typename ScalarTypes<T>::StatusWord status;
};

template <class T>
[[nodiscard]] constexpr bool find_point(const CondensedTables<T>& valve, const Sample<T>& sample,
                                        CondensedPoint<T>& point) {
  using Layout = CondensedLayout;
  constexpr Status beyond = Status::outside_force_map;
  point.status = {};
  if constexpr (one_valve<T>) {
    return find_place<Layout::position_cells>(valve.cells_per_m, sample.position_m, beyond, point.position,
                                              point.status) &&
           find_place<Layout::current_cells>(valve.cells_per_A, sample.current_A, beyond, point.current,
                                             point.status) &&
           within(sample.time_step_s, T(longest_step_s));
  } else {
    const T position_cells = sample.position_m * valve.cells_per_m;
    const T current_cells = sample.current_A * valve.cells_per_A;
    point.position = blended_place<Layout::position_cells>(position_cells);
    point.current = blended_place<Layout::current_cells>(current_cells);
    point.status = when(
        !(is_near<Layout::position_cells>(position_cells) && is_near<Layout::current_cells>(current_cells)), beyond);
    return true;
  }
}

/// The reason why there is no point.
template <class T>
constexpr Status why_held(const Sample<T>& sample) {
  const Status reason = unusable(sample);
  if (reason != Status::none) return reason;
  return within(sample.time_step_s, T(longest_step_s)) ? Status::sample_missing : Status::time_fault;
}

/// The root of the flow force in cells; `cells2`, its square, is taken to the end of the axis where it lies beyond.
template <class T>
constexpr Place<T> find_root(const Truth<T>& closed, T& cells2, typename ScalarTypes<T>::StatusWord& status) {
  constexpr int cells = CondensedLayout::root_cells;
  constexpr Status beyond = Status::outside_flow_force_map;
  if constexpr (one_valve<T>) {
    return root_place<cells>(cells2, closed ? Status::none : beyond, status);
  } else {
    mark(status, !closed && !(cells2 >= T(0) && cells2 < T(cells * cells)), beyond);
    cells2 = limited(cells2, T(0), T(cells * cells));
    return blended_place<cells>(sqrt(cells2));
  }
}

}  // namespace detail

/// One sample through the chain: magnetic force, spring, flow force, flow rate. Friction, hysteresis and inertia are
/// left out (paper section 3) and stand in the band instead. Needs current and position, and a time that does not run
/// backwards: otherwise the last answer is held. Other inputs are not read. The answer stays in the state.
template <class T>
constexpr const Estimate<T>& step(const CondensedTables<T>& valve, CondensedState<T>& state, const Sample<T>& sample) {
  using Layout = CondensedLayout;
  Estimate<T>& out = state.last;
  detail::CondensedPoint<T> point;
  if (!detail::find_point(valve, sample, point)) [[unlikely]] {
    if constexpr (one_valve<T>) out.status = detail::why_held(sample);
    return out;
  }
  const T x = point.position.cells;
  const auto here = corner(valve.records.data(), point.position.index * Layout::record);
  const auto line = [&](const auto& from, int number) { return from[number] + x * from[number + 1]; };

  // Forces: paper (1) without friction and inertia.
  const auto by_current = onward(here, point.current.index * Layout::plane);
  const T magnetic_force_N = line(by_current, Layout::magnetic_force) +
                             point.current.cells * line(by_current, Layout::magnetic_force + Layout::line);
  const T spring_force_N = line(here, Layout::spring);
  const T flow_force_N = magnetic_force_N - spring_force_N;

  // Flow rate: at a fixed opening nearly linear in the root of the flow force (paper (2)).
  T cells2 = flow_force_N / line(here, Layout::force_per_cells2);
  const Truth<T> closed = lies_below(x, valve.closed_below_cells);
  mark(point.status, closed, Status::closed);
  const Place<T> root = detail::find_root(closed, cells2, point.status);
  const auto by_root = onward(here, root.index * Layout::flow_cell);
  const T slope_m3_per_s = line(by_root, Layout::flow + Layout::line);
  const T flow_m3_per_s = line(by_root, Layout::flow) + root.cells * slope_m3_per_s;
  const T root_pressure = line(by_root, Layout::flow + Layout::root_pressure) +
                          root.cells * line(by_root, Layout::flow + Layout::root_pressure + Layout::line);

  // Band: what the forces' uncertainty means for the root, along the map's slope.
  const T uncertainty_cells2 = line(here, Layout::uncertainty);
  const T above = sqrt(cells2 + uncertainty_cells2) - root.cells;
  const T below = root.cells - sqrt(at_least_zero(cells2 - uncertainty_cells2));

  const Estimate<T> before = out;
  out.flow_m3_per_s = flow_m3_per_s;
  out.flow_lower_m3_per_s = flow_m3_per_s - valve.flow_residual_m3_per_s - below * slope_m3_per_s;
  out.flow_upper_m3_per_s = flow_m3_per_s + valve.flow_residual_m3_per_s + above * slope_m3_per_s;
  out.pressure_difference_Pa = squared(root_pressure);
  out.magnetic_force_N = magnetic_force_N;
  out.spring_force_N = spring_force_N;
  out.flow_force_N = flow_force_N;
  out.status = point.status;
  if constexpr (!one_valve<T>) hold(unusable(sample), before, out);
  return out;
}

}  // namespace spoolflow::sensor
