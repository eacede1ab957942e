#pragma once
/// The paper's condensed sensor (section 3, Fig 4): two averaged maps and the springs.
#include <array>
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/condensed_tables.hpp"

namespace spoolflow::sensor {

/// The condensed sensor remembers only its last answer, which it holds where a sample is missing.
template <class T>
struct CondensedState {
  Estimate<T> last{};
};

static_assert(std::is_trivially_copyable_v<CondensedState<float>>);

namespace detail {

/// A point in the tables, and its status.
template <class T>
struct CondensedPoint {
  Place<T> position;
  Place<T> current;
  Status status;
};

/// Whether the spool opens the other direction of flow, of which a model of one direction knows nothing.
template <class T>
constexpr bool opens_other_direction(const CondensedTables<T>& valve, T position_m) {
  const T least_cells = T(0.5) * valve.closed_below_cells + T(other_direction_m) * valve.cells_per_m;
  return position_m * valve.cells_per_m < -least_cells;
}

/// False where there is none: a value is missing, or, as the status says, the spool opens the other direction.
template <class T>
[[nodiscard]] constexpr bool find_point(const CondensedTables<T>& valve, const Sample<T>& sample,
                                        CondensedPoint<T>& point) {
  using Layout = CondensedLayout;
  constexpr Status beyond = Status::outside_force_map;
  point.status = {};
  if (!find_place<Layout::position_cells>(valve.cells_per_m, sample.position_m, beyond, point.position, point.status))
    return false;
  if (point.status != Status::none && opens_other_direction(valve, sample.position_m)) {
    point.status |= Status::other_direction;
    return false;
  }
  return find_place<Layout::current_cells>(valve.cells_per_A, sample.current_A, beyond, point.current, point.status) &&
         within(sample.time_step_s, T(endless_step_s));
}

/// The reason why there is no point.
template <class T>
constexpr Status why_held(const Sample<T>& sample) {
  const Status reason = unusable(sample);
  if (reason != Status::none) return reason;
  return within(sample.time_step_s, T(endless_step_s)) ? Status::sample_missing : Status::time_fault;
}

/// The root of the flow force in cells; `cells2`, its square, is taken to the end of the axis where it lies beyond.
/// The status says so of an open valve; of a closed one, that it is closed.
template <class T>
constexpr Place<T> find_root(bool closed, T& cells2, Status& status) {
  constexpr int cells = CondensedLayout::root_cells;
  constexpr Status beyond = Status::outside_flow_force_map;
  if (closed) {  // a way of its own: nothing then waits in a register for a place beyond the axis
    status |= Status::closed;
    return root_place<cells>(cells2, Status::none, status);
  }
  return root_place<cells>(cells2, beyond, status);
}

/// The most that may flow at a position [m3/s]: at the largest flow force of the map.
template <class T>
constexpr T largest_flow(const CondensedTables<T>& valve, T position_m) {
  using Layout = CondensedLayout;
  Status ignored{};
  Place<T> place{};
  if (!find_place<Layout::position_cells>(valve.cells_per_m, position_m, Status::none, place, ignored)) return T(0);
  const auto here = valve.records.data() + place.index * Layout::record;
  const auto last = here + ((Layout::root_cells - 1) * Layout::flow_cell);
  const auto [flow, flow_rise, flow_more, flow_more_rise] = four(last, Layout::flow);
  return flow + place.cells * flow_rise + T(Layout::root_cells) * (flow_more + place.cells * flow_more_rise);
}

/// In the other direction flows between nothing and what may flow at the same opening through the own edge.
template <class T>
SPOOLFLOW_NOINLINE constexpr void answer_other_direction(const CondensedTables<T>& valve, const Sample<T>& sample,
                                                         Estimate<T>& out) {
  out.flow_m3_per_s = T(0);
  out.flow_lower_m3_per_s = -at_least_zero(largest_flow(valve, -sample.position_m)) - valve.flow_residual_m3_per_s;
  out.flow_upper_m3_per_s = valve.flow_residual_m3_per_s;
  out.status = Status::other_direction | Status::closed | Status::outside_force_map | unusable(sample);
}

}  // namespace detail

/// A sample that cannot be used: the last flow is held, and its band opens to all that may flow, at the position that
/// is measured or, without one, at any.
template <class T>
SPOOLFLOW_NOINLINE constexpr void hold(const CondensedTables<T>& valve, CondensedState<T>& state,
                                       const Sample<T>& sample) {
  Estimate<T>& out = state.last;
  const T end_m = T(CondensedLayout::position_cells) / valve.cells_per_m;
  const T position_m = is_number(sample.position_m) ? limited(sample.position_m, T(0), end_m) : end_m;
  const T most_m3_per_s = detail::largest_flow(valve, position_m) + valve.flow_residual_m3_per_s;
  if (within(sample.time_step_s, T(endless_step_s))) {
    open_band(out, {-valve.flow_residual_m3_per_s, most_m3_per_s}, false, sample.time_step_s);
  }
  out.status = detail::why_held(sample);
}

/// One sample through the chain: magnetic force, spring, flow force, flow rate. Friction, hysteresis and inertia are
/// left out (paper section 3) and stand in the band instead. Needs current and position, and a time that does not run
/// backwards: otherwise the last flow is held. Other inputs are not read. Where the spool opens the other direction the
/// flow is zero with a band over all that may flow there, and pressure difference and forces are the last ones. The
/// answer stays in the state.
template <class T>
constexpr const Estimate<T>& step(const CondensedTables<T>& valve, CondensedState<T>& state, const Sample<T>& sample) {
  using Layout = CondensedLayout;
  Estimate<T>& out = state.last;
  detail::CondensedPoint<T> point;
  if (unlikely(!detail::find_point(valve, sample, point))) {
    if (has(point.status, Status::other_direction)) {
      detail::answer_other_direction(valve, sample, out);
    } else {
      hold(valve, state, sample);
    }
    return out;
  }
  const T x = point.position.cells;
  const auto here = valve.records.data() + point.position.index * Layout::record;
  const auto line = [&](T at_zero, T rise) { return at_zero + x * rise; };
  const auto [spring, spring_rise, scale, scale_rise] = four(here, Layout::spring);

  // Forces: paper (1) without friction and inertia.
  const auto [force, force_rise, force_more, force_more_rise] =
      four(here + point.current.index * Layout::plane, Layout::magnetic_force);
  const T magnetic_force_N = line(force, force_rise) + point.current.cells * line(force_more, force_more_rise);
  const T spring_force_N = line(spring, spring_rise);
  const T flow_force_N = magnetic_force_N - spring_force_N;

  // Flow rate: at a fixed opening nearly linear in the root of the flow force (paper (2)).
  T cells2 = flow_force_N / line(scale, scale_rise);
  const bool closed = lies_below(x, valve.closed_below_cells);
  const Place<T> root = detail::find_root(closed, cells2, point.status);
  const auto by_root = here + root.index * Layout::flow_cell;
  const auto [flow, flow_rise, flow_more, flow_more_rise] = four(by_root, Layout::flow);
  const T begin_m3_per_s = line(flow, flow_rise);
  const T slope_m3_per_s = line(flow_more, flow_more_rise);
  const auto [pressure, pressure_rise, pressure_more, pressure_more_rise] =
      four(by_root, Layout::flow + Layout::root_pressure);

  // Band: what the forces' uncertainty means for the root, along the map's slope.
  const auto uncertain = four(here, Layout::uncertainty);
  const T uncertainty_cells2 = line(uncertain[0], uncertain[1]);
  const T root_above = sqrt(cells2 + uncertainty_cells2);
  const T root_below = sqrt(at_least_zero(cells2 - uncertainty_cells2));

  out.flow_m3_per_s = begin_m3_per_s + root.cells * slope_m3_per_s;
  out.flow_lower_m3_per_s = begin_m3_per_s - valve.flow_residual_m3_per_s + root_below * slope_m3_per_s;
  out.flow_upper_m3_per_s = begin_m3_per_s + valve.flow_residual_m3_per_s + root_above * slope_m3_per_s;
  out.pressure_difference_Pa =
      squared(line(pressure, pressure_rise) + root.cells * line(pressure_more, pressure_more_rise));
  out.magnetic_force_N = magnetic_force_N;
  out.spring_force_N = spring_force_N;
  out.flow_force_N = flow_force_N;
  out.status = point.status;
  return out;
}

}  // namespace spoolflow::sensor
