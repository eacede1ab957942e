#pragma once
/// Dither requests (dither_request.hpp) beside the whole valve's step: the same limits on either side of the centre,
/// dither for the solenoid of the side on which the spool stands.
#include "spoolflow/sensor/dither_request.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_parameters.hpp"

namespace spoolflow::sensor {

/// After each step of the whole valve; see the same of one direction. A request ends where the spool covers the edges,
/// and one on the other side starts from zero.
template <class T>
constexpr DitherRequest<T> request_dither(const DitherRequestParameters<T>& limits, DitherRequestState<T>& state,
                                          const WholeValveParameters<T>& valve, const WholeValveState<T>& observer,
                                          T time_step_s) {
  const ObserverParameters<T>& open = observer.opens_a ? *valve.a : *valve.b;
  const T from_centre_m = observer.open.position.last_m;  // in the valve's signs
  const T position_m = observer.opens_a ? -from_centre_m : from_centre_m;
  return detail::request_dither(limits, state, detail::dither_need(limits, open, observer.open, position_m),
                                time_step_s);
}

}  // namespace spoolflow::sensor
