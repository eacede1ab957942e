#pragma once
/// A model of one direction knows nothing of the other, where as much may flow as through its own edge.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

namespace detail {

/// The band takes in all that may flow through the other direction's edge.
template <class T>
SPOOLFLOW_NOINLINE constexpr void admit_all(const ObserverParameters<T>& valve, const Cell<T>& oil_layer, T position_m,
                                            Estimate<T>& out) {
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  const T most = valve.edge.conductance_at(oil_layer, highest_Pa, -position_m) * sqrt(highest_Pa);
  out.flow_lower_m3_per_s = smaller(out.flow_lower_m3_per_s, -most);
  out.status |= Status::other_direction;
}

}  // namespace detail

/// Where the position says that the spool opens the other direction.
template <class T>
SPOOLFLOW_INLINE constexpr void admit_other_direction(const ObserverParameters<T>& valve, const Cell<T>& oil_layer,
                                                      T position_m, Estimate<T>& out) {
  const bool opens = position_m < T(-0.5) * valve.closed_below_m - T(other_direction_m);
  if (unlikely(opens)) detail::admit_all(valve, oil_layer, position_m, out);
}

}  // namespace spoolflow::sensor
