#pragma once
/// When the spool breaks away, friction before it was all that the contacts could hold after that rest: one measurement
/// of the pressure difference, as sure as break-away forces repeat.
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"

namespace spoolflow::sensor {

/// A spool breaks away only after so long a rest [s]: shorter ones are part of a motion.
inline constexpr double shortest_rest_s = 0.03;
/// Dither motion loosens contacts that age: what ageing has added is as sure as this share of it, one standard
/// deviation.
inline constexpr double loosened_ageing_share = 0.25;

/// Whether the spool, which does not cover the edge, breaks away with this sample.
template <class T>
SPOOLFLOW_INLINE constexpr bool breaks_away(const ForceBalance<T>& balance, T time_step_s) {
  return balance.slips && !is_zero(balance.resting.breakaway_N) &&
         balance.resting.rested_s > T(shortest_rest_s) + T(0.5) * time_step_s;
}

/// What the spool and its armature hold after that rest [N].
template <class T>
SPOOLFLOW_INLINE constexpr T breakaway_limit_N(const FrictionParameters<T>& friction, const ForceBalance<T>& balance) {
  return ageing(friction, balance.resting.rested_s) * balance.spool_friction_N + balance.armature_friction_N;
}

template <class T>
SPOOLFLOW_INLINE constexpr ForceInnovation<T> breakaway_innovation(const FrictionParameters<T>& friction,
                                                                   const ForceBalance<T>& balance, T friction_ratio) {
  const T aged = ageing(friction, balance.resting.rested_s);
  const T limit_N = breakaway_limit_N(friction, balance);
  const T expected_N = balance.direction * at_least_zero(limit_N - balance.half_swing_N);
  const T loosened_N = balance.dithered ? T(loosened_ageing_share) * (aged - T(1)) * balance.spool_friction_N : T(0);
  return {balance.resting.breakaway_N - expected_N,
          whole_slope_N_per_Pa(balance.edge.flow_force_per_pressure_N_Pa,
                               balance.direction * aged * (friction_ratio * balance.edge.friction_per_pressure_N_Pa)),
          balance.direction * (aged * balance.edge.friction_N + balance.actuator.friction_half_width_N),
          sqrt(squared(balance.noise_N) + squared(loosened_N) + squared(friction.breakaway_share * limit_N))};
}

/// Update of the pressure difference alone, since stiction says little of sliding friction. `common_N` is one standard
/// deviation of what all break-away forces may be off by alike: no number of them averages it away.
template <class T>
constexpr void update_breakaway(const PressureParameters<T>& pressure, PressureState<T>& state,
                                const ForceInnovation<T>& innovation, T common_N, T highest_Pa) {
  const KalmanUpdate<T> update = weigh(state, innovation, squared(innovation.noise_N), T(0), highest_Pa);
  correct_pressure(pressure, state, update, highest_Pa);
  state.breakaway_Pa += update.gain_Pa_per_N * common_N;
}

}  // namespace spoolflow::sensor
