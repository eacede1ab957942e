#pragma once
/// A load that passes other flows over both edges only once it has settled: behind a cylinder of unequal areas the
/// drops stand in the calibrated proportion when pressures in its chambers have become steady. Until then the force,
/// which is made by their sum, says less of the flow.
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// A load settles to another flow at about this pace [s].
inline constexpr double load_settling_s = 0.3;

/// One more sample of `time_step_s` >= 0, where `share` > 0: `settled_m3_per_s` goes on towards the answer, both in the
/// direction's sign, and the answer's band takes in `share` of what is between them.
template <class T>
constexpr void widen_unsettled(T share, T& settled_m3_per_s, T time_step_s, Estimate<T>& out) {
  const bool unsettled = share > T(0);
  if (unsettled)
    settled_m3_per_s += (out.flow_m3_per_s - settled_m3_per_s) * smaller(time_step_s / T(load_settling_s), T(1));
  if (unsettled) widen_band(out, squared(share * (out.flow_m3_per_s - settled_m3_per_s)));
}

}  // namespace spoolflow::sensor
