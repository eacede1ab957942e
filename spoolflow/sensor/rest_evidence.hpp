#pragma once
/// At rest friction lies between bounds. A residual force beyond them is evidence: the pressure difference, or
/// friction's estimate, is moved until the bounds hold (constrained correction). Within them a sample says nothing.
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"

namespace spoolflow::sensor {

/// By how much the residual force lies beyond what friction at rest can be [N]; 0 where it lies within, or nothing can
/// be said of it.
template <class T>
SPOOLFLOW_INLINE constexpr T beyond_bounds_N(const ForceBalance<T>& balance) {
  const T beyond_N = balance.residual_force_N - balance.friction_N;
  if (likely(is_zero(beyond_N))) return T(0);
  const bool rests = balance.settled && !balance.closed && !balance.sliding && !balance.slips;
  return rests ? beyond_N : T(0);
}

/// Moves the pressure difference by its share in what brings the force back within the bounds, at the pace of
/// `time_step_s`; returns the force left to the other explanation, friction [N].
template <class T>
constexpr T correct_constrained(const PressureParameters<T>& pressure, PressureState<T>& state,
                                const ForceInnovation<T>& beyond, T time_step_s, T highest_Pa) {
  const T prior_N2 = squared(beyond.slope_N_per_Pa) * state.variance_Pa2;
  const T share = prior_N2 / (prior_N2 + squared(beyond.noise_N));
  const T force_N = smaller(time_step_s / pressure.constrained_correction_s, T(1)) * beyond.force_N;
  const T before_Pa = state.pressure_difference_Pa;
  state.pressure_difference_Pa = limited(before_Pa + share * force_N / beyond.slope_N_per_Pa, T(0), highest_Pa);
  const T change_Pa = state.pressure_difference_Pa - before_Pa;
  state.constrained_correction_Pa =
      change_Pa + (change_Pa * state.constrained_correction_Pa < T(0) ? T(0) : state.constrained_correction_Pa);
  return (T(1) - share) * force_N;
}

/// Friction's estimate in pre-sliding takes the force [N] that is left to it, as far as the contacts hold it.
template <class T>
SPOOLFLOW_INLINE constexpr void correct_friction(FrictionState<T>& contacts, const ForceBalance<T>& balance,
                                                 T force_N) {
  if (magnitude(balance.residual_force_N) < balance.bounds.sticking_N) contacts.presliding_N += force_N;
}

}  // namespace spoolflow::sensor
