#pragma once
/// What a force balance tells of the pressure difference. While the spool slides every newton tells; at a break-away
/// friction stands at its limit; at rest only what friction cannot explain tells, else nothing does.
#include "spoolflow/sensor/compiler.hpp"
#include "spoolflow/sensor/force_balance.hpp"

namespace spoolflow::sensor {

/// Friction grows with pressure against the flow force when the spool closes: what is left of the slope of both
/// together is taken for no less than this share of the flow force's.
inline constexpr double least_slope_share = 0.3;
/// A spool breaks away only after so long a rest [s]: shorter ones are part of a motion.
inline constexpr double shortest_rest_s = 0.03;

/// The tremble of dither loosens contacts that grow old: what ageing has added is as sure as this share of it, one
/// standard deviation.
inline constexpr double loosened_ageing_share = 0.25;

/// Where friction lies: `slope` of the flow force over the pressure difference, friction's taken with it.
template <class T>
SPOOLFLOW_INLINE constexpr T whole_slope_N_per_Pa(T slope_N_per_Pa, T friction_slope_N_per_Pa) {
  return larger(slope_N_per_Pa + friction_slope_N_per_Pa, T(least_slope_share) * slope_N_per_Pa);
}

/// The innovation while the spool slides.
template <class T>
SPOOLFLOW_INLINE constexpr ForceInnovation<T> sliding_innovation(const ForceBalance<T>& balance,
                                                                 T friction_slope_N_per_Pa) {
  return {balance.apparent_friction_N - balance.friction_N,
          whole_slope_N_per_Pa(balance.edge.flow_force_per_pressure_N_Pa, balance.direction * friction_slope_N_per_Pa),
          balance.direction * (balance.edge.friction_N + balance.actuator.friction_half_width_N), balance.noise_N};
}

/// The innovation when the spool breaks away: friction before it was all that the contacts could hold after that rest.
template <class T>
SPOOLFLOW_INLINE constexpr ForceInnovation<T> breakaway_innovation(const FrictionParameters<T>& friction,
                                                                   const ForceBalance<T>& balance,
                                                                   T friction_slope_N_per_Pa) {
  const T aged = ageing(friction, balance.resting.rested_s);
  const T limit_N = aged * balance.spool_friction_N + balance.armature_friction_N;
  const T expected_N = balance.direction * larger(limit_N - balance.half_swing_N, T(0));
  const T loosened_N = balance.dithered ? T(loosened_ageing_share) * (aged - T(1)) * balance.spool_friction_N : T(0);
  return {balance.resting.breakaway_N - expected_N,
          whole_slope_N_per_Pa(balance.edge.flow_force_per_pressure_N_Pa,
                               balance.direction * aged * friction_slope_N_per_Pa),
          balance.direction * (aged * balance.edge.friction_N + balance.actuator.friction_half_width_N),
          sqrt(squared(balance.noise_N) + squared(loosened_N) + squared(friction.breakaway_share * limit_N))};
}

/// Prediction over one sample: the supply may have moved.
template <class T>
SPOOLFLOW_INLINE constexpr void predict(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                        const ForceBalance<T>& balance, bool slow, T time_step_s, T highest_Pa) {
  PressureState<T>& pressure = state.pressure;
  if (balance.closed) expect_change(valve.pressure, pressure);
  if (balance.sliding) drift(valve.pressure, pressure, time_step_s, highest_Pa);
  if (balance.sliding && slow) {
    forget_ratio(valve.pressure, pressure, valve.friction.operation_ratio, slow_period_s(state.position));
  }
  if (!balance.sliding) drift_unseen(valve.pressure, pressure, time_step_s, highest_Pa);
}

/// Prediction, then what the forces tell: the spool slides, breaks away, rests and yields, or nothing is seen.
template <class T>
SPOOLFLOW_INLINE constexpr void believe(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                        const ForceBalance<T>& balance, const PositionPoint<T>& position,
                                        T time_step_s) {
  PressureState<T>& pressure = state.pressure;
  const T highest_Pa = valve.highest_pressure_difference_Pa();
  const T slope = balance.edge.flow_force_per_pressure_N_Pa;
  const T friction_slope = pressure.friction_ratio * balance.edge.friction_per_pressure_N_Pa;
  predict(valve, state, balance, position.turn.slow_even, time_step_s, highest_Pa);

  if (balance.settled && !balance.closed && balance.sliding) {
    if (time_step_s > T(0))
      update_sliding(valve.pressure, pressure, sliding_innovation(balance, friction_slope), time_step_s, highest_Pa);
    if (!position.turn.even) return;
    drop_covariance(pressure);
    if (observed(pressure, slope, balance.noise_N))
      learn_process_noise(valve.pressure, pressure, balance.noise_N / slope);
  }
  const bool breaks = !balance.closed && !balance.sliding && !is_zero(balance.resting.breakaway_N) &&
                      balance.resting.rested_s > T(shortest_rest_s) + T(0.5) * time_step_s;
  if (breaks) {
    update_breakaway(valve.pressure, pressure, breakaway_innovation(valve.friction, balance, friction_slope),
                     highest_Pa);
  }
  const T beyond_N = balance.apparent_friction_N - balance.friction_N;
  const bool yields = balance.settled && !balance.closed && !balance.sliding && !breaks &&
                      (position.motion == Motion::rest) && !is_zero(beyond_N);
  if (yields) {
    // Friction that holds more than calibrated shows likewise: alone it leads to no pressure difference beyond that.
    const T most_Pa = larger(pressure.pressure_difference_Pa, valve.edge.highest_pressure_difference_Pa());
    const T left_N =
        yield(valve.pressure, pressure, {beyond_N, slope, T(0), valve.friction.tolerance_N}, time_step_s, most_Pa);
    const bool holds = magnitude(balance.apparent_friction_N) < balance.bounds.sticking_N;
    const T gauge_N = state.friction.gauge_N;
    if (holds) state.friction.gauge_N = gauge_N + left_N;
  }
  if (broken(pressure))
    begin(valve.pressure, pressure, highest_Pa, valve.friction.operation_ratio, valve.band.unseen_factor);
}

}  // namespace spoolflow::sensor
