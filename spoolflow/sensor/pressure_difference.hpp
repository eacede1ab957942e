#pragma once
/// The hidden state: the pressure difference over the metering edge. Position is measured, so a flow change that the
/// spool causes costs no lag; only a pressure change must be found through the forces.
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// How the pressure difference is believed to move.
template <class T>
struct PressureParameters {
  T sliding_drift_Pa_per_sqrt_s{};  ///< random walk while the spool slides and every newton tells
  T resting_drift_Pa_per_sqrt_s{};  ///< random walk otherwise
  T yielding_s{};                   ///< how fast it gives way to a force that friction at rest cannot explain
};

template <class T>
struct PressureState {
  T pressure_difference_Pa{};
  T variance_Pa2{};
};

/// A force balance as a measurement of the pressure difference.
template <class T>
struct ForceSurprise {
  T force_N;         ///< what the believed pressure difference leaves unexplained, > 0 asks for more flow force
  T slope_N_per_Pa;  ///< flow force over pressure difference
  T noise_N;         ///< one standard deviation
};

template <class T>
constexpr void drift(PressureState<T>& state, T drift_Pa_per_sqrt_s, T time_step_s, T highest_Pa) {
  state.variance_Pa2 =
      smaller(state.variance_Pa2 + squared(drift_Pa_per_sqrt_s) * time_step_s, squared(T(0.4) * highest_Pa));
}

/// Scalar Kalman update. A surprise beyond three standard deviations opens the variance: the pressure has changed.
template <class T>
constexpr void update(PressureState<T>& state, const ForceSurprise<T>& surprise, T time_step_s) {
  const T slope2 = squared(surprise.slope_N_per_Pa);
  const T noise2 = squared(surprise.noise_N);
  const T expected2 = slope2 * state.variance_Pa2 + noise2;
  const T excess2 = squared(surprise.force_N) * T(1.0 / 9) - expected2;
  constexpr T opening_s = T(0.05);
  if (excess2 > T(0)) state.variance_Pa2 += excess2 / slope2 * smaller(time_step_s / opening_s, T(1));
  const T gain = state.variance_Pa2 * surprise.slope_N_per_Pa / (slope2 * state.variance_Pa2 + noise2);
  state.pressure_difference_Pa += gain * surprise.force_N;
  state.variance_Pa2 *= T(1) - gain * surprise.slope_N_per_Pa;
}

/// Moves the pressure difference by the least that brings the force back into what friction at rest can explain.
template <class T>
constexpr void yield(PressureState<T>& state, const ForceSurprise<T>& beyond, T yielding_s, T time_step_s) {
  state.pressure_difference_Pa += smaller(time_step_s / yielding_s, T(1)) * beyond.force_N / beyond.slope_N_per_Pa;
  state.variance_Pa2 = larger(state.variance_Pa2, squared(T(0.5) * beyond.noise_N / beyond.slope_N_per_Pa));
}

static_assert(std::is_trivially_copyable_v<PressureState<float>>);

}  // namespace spoolflow::sensor
