#pragma once
/// The answer while no force shows the pressure difference: what is known of it ages, and the band takes in all that
/// may flow.
#include "spoolflow/sensor/band.hpp"
#include "spoolflow/sensor/basis/compiler.hpp"

namespace spoolflow::sensor {

/// What is left while no force is used.
template <class T>
struct Unobserved {
  PressureState<T>& pressure;
  const ForceErrors<T>& errors;
  const Cell<T>& oil_layer;
};

/// Where the spool may stand while forces are not used.
template <class T>
struct DoubtfulPlace {
  T position_m;
  T elsewhere_m;  ///< where it is instead, if it is not there
  bool fault;     ///< of the position signal
  bool stopped;   ///< on the open stop
};

/// What passes at both places; beyond the centre as much as through the direction's own edge.
template <class T>
constexpr Passage<T> passage_at(const MeteringEdge<T>& edges, const EdgePoint<T>& edge, const Unobserved<T>& known,
                                const DoubtfulPlace<T>& position) {
  const T here = at_least_zero(edge.conductance);
  if (!position.fault) return {here, here, here};
  const T there =
      edges.conductance_at(known.oil_layer, known.pressure.pressure_difference_Pa, magnitude(position.elsewhere_m));
  const T elsewhere = position.elsewhere_m < T(0) ? -there : there;
  return {here, smaller(here, elsewhere), larger(here, elsewhere)};
}

/// Where the spool stands while an answer is held.
template <class T>
struct HeldPosition {
  T position_m;  ///< free of drift, in the direction's signs; the last one where none is measured
  bool seen;     ///< it is measured
};

/// One more sample of `time_step_s` >= 0: the band of the held answer, in the direction's signs, takes in what may flow
/// at the position, or without one between nothing and what the edge passes when it is wide open. The flow itself
/// stays.
template <class T>
SPOOLFLOW_INLINE constexpr void widen_held(const ObserverParameters<T>& valve, const Unobserved<T>& known,
                                           const HeldPosition<T>& at, T time_step_s, Estimate<T>& held) {
  const MeteringEdge<T>& edges = valve.edge;
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  drift_unobserved(valve.pressure, known.pressure, smaller(time_step_s, T(longest_step_s)), highest_Pa);
  const T pressure_Pa = known.pressure.pressure_difference_Pa;
  const EdgePoint<T> edge = edges.at(known.oil_layer, pressure_Pa, at.position_m);
  const T open_conductance =
      edges.conductance_at(known.oil_layer, pressure_Pa, edges.position_m.at(edge_positions - 1));
  const T least = at.seen ? edge.conductance : T(0);
  const Passage<T> passage{least, least, at.seen ? edge.conductance : open_conductance};
  Estimate<T> now{};
  const PressureHalfWidths<T> widths = unobserved_half_widths(valve.band, known.pressure, known.errors, edge);
  answer_flow(valve, passage, pressure_band(known.pressure, widths, highest_Pa), now);
  open_band(held, {now.flow_lower_m3_per_s, now.flow_upper_m3_per_s}, at.seen, time_step_s);
}

/// The most that a direction passes [m3/s]: wide open, at the highest pressure difference that is answered.
template <class T>
constexpr T most_flow(const ObserverParameters<T>& valve) {
  const MeteringEdge<T>& edges = valve.edge;
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  return edges.conductance_at(Cell<T>{1, T(0)}, highest_Pa, edges.position_m.at(edge_positions - 1)) * sqrt(highest_Pa);
}

}  // namespace spoolflow::sensor
