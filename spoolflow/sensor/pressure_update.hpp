#pragma once
/// One sample of the hidden pressure difference: prediction, then the evidence of a spool that slides, breaks away or
/// rests; where it covers the edge there is none.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/breakaway_evidence.hpp"
#include "spoolflow/sensor/closed_evidence.hpp"
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/rest_evidence.hpp"
#include "spoolflow/sensor/sliding_evidence.hpp"

namespace spoolflow::sensor {

/// When the slow parts of the update run, and the sample's time step.
template <class T>
struct PressureTiming {
  Due<T> friction_ratio;
  bool process_noise;  ///< due
  T time_step_s;
};

namespace detail {

/// Prediction over one sample: the supply may have moved.
template <class T>
SPOOLFLOW_INLINE constexpr void predict(const ObserverParameters<T>& valve, PressureState<T>& pressure, bool sliding,
                                        const PressureTiming<T>& timing, T highest_Pa) {
  if (sliding) {
    drift(valve.pressure, pressure, timing.time_step_s, highest_Pa);
    if (timing.friction_ratio.now)
      forget_ratio(valve.pressure, pressure, valve.friction.operation_ratio, timing.friction_ratio.since_s());
  } else {
    drift_unobserved(valve.pressure, pressure, timing.time_step_s, highest_Pa);
  }
}

/// What the forces on a spool show that slides.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_sliding(const ObserverParameters<T>& valve, PressureState<T>& pressure,
                                               const ForceBalance<T>& balance, const PressureTiming<T>& timing,
                                               T friction_ratio, T highest_Pa) {
  if (timing.time_step_s > T(0))
    update_sliding(valve.pressure, pressure, sliding_innovation(balance, friction_ratio), timing.time_step_s,
                   highest_Pa);
  if (timing.process_noise)
    follow_process_noise(valve.pressure, pressure, balance.edge.flow_force_per_pressure_N_Pa, balance.noise_N);
}

/// What they show on one that does not. Returns the force [N] that is left to friction.
template <class T>
SPOOLFLOW_INLINE constexpr T follow_resting(const ObserverParameters<T>& valve, PressureState<T>& pressure,
                                            const ForceBalance<T>& balance, T time_step_s, T highest_Pa) {
  if (breaks_away(balance, time_step_s)) {
    const T common_N = balance.direction * valve.friction.breakaway_share * breakaway_limit_N(valve.friction, balance);
    update_breakaway(valve.pressure, pressure, breakaway_innovation(valve.friction, balance, pressure.friction_ratio),
                     common_N, highest_Pa);
    return T(0);
  }
  const T beyond_N = beyond_bounds_N(balance);
  if (is_zero(beyond_N)) return T(0);
  // Friction that holds more than calibrated looks alike: alone it leads to no pressure difference beyond that.
  const T most_Pa = larger(pressure.pressure_difference_Pa, valve.edge.highest_pressure_difference_Pa());
  const T slope = balance.edge.flow_force_per_pressure_N_Pa;
  return correct_constrained(valve.pressure, pressure, {beyond_N, slope, T(0), valve.friction.tolerance_N}, time_step_s,
                             most_Pa);
}

}  // namespace detail

/// Prediction and update of the pressure difference. Returns the force [N] by which friction's estimate in pre-sliding
/// is to be corrected, as the other explanation of what its bounds do not hold. `closed()` is called where the spool
/// covers the edge and shows no pressure.
template <class T, class Closed>
SPOOLFLOW_INLINE constexpr T update(const ObserverParameters<T>& valve, PressureState<T>& pressure,
                                    const ForceBalance<T>& balance, const PressureTiming<T>& timing,
                                    const Closed& closed) {
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  const T friction_ratio = pressure.friction_ratio;
  T to_friction_N{};
  if (balance.closed) {
    expect_change(valve.pressure, pressure);
    detail::predict(valve, pressure, balance.sliding, timing, highest_Pa);
    closed();
  } else if (balance.sliding) {
    detail::predict(valve, pressure, true, timing, highest_Pa);
    if (balance.settled) detail::follow_sliding(valve, pressure, balance, timing, friction_ratio, highest_Pa);
  } else {
    detail::predict(valve, pressure, false, timing, highest_Pa);
    to_friction_N = detail::follow_resting(valve, pressure, balance, timing.time_step_s, highest_Pa);
  }
  if (unlikely(broken(pressure)))
    begin(valve.pressure, pressure, highest_Pa, valve.friction.operation_ratio, valve.band.unobserved_factor);
  return to_friction_N;
}

}  // namespace spoolflow::sensor
