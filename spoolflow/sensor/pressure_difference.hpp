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
  T resting_drift_Pa_per_sqrt_s{};  ///< random walk while nobody sees it, where the supply is at its liveliest
  T least_liveliness{};             ///< share of that drift where the supply has proved steady, (0, 1]
  T yielding_s{};                   ///< how fast it gives way to a force that friction at rest cannot explain
};

template <class T>
struct PressureState {
  T pressure_difference_Pa{};
  T variance_Pa2{};
  T liveliness{};  ///< variance of unseen changes over that of the resting drift
  T settled_Pa{};  ///< when last seen
  T unseen_Pa2{};  ///< variance that has built up since, at full liveliness
};

/// A force balance as a measurement of the pressure difference.
template <class T>
struct ForceSurprise {
  T force_N;         ///< what the believed pressure difference leaves unexplained, > 0 asks for more flow force
  T slope_N_per_Pa;  ///< of the force that is explained over pressure difference
  T noise_N;         ///< one standard deviation
};

template <class T>
constexpr void drift(PressureState<T>& state, T drift_Pa_per_sqrt_s, T time_step_s, T highest_Pa) {
  state.variance_Pa2 =
      smaller(state.variance_Pa2 + squared(drift_Pa_per_sqrt_s) * time_step_s, squared(T(0.4) * highest_Pa));
}

/// The same while nothing tells: as lively as the supply has shown itself.
template <class T>
constexpr void drift_unseen(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s,
                            T highest_Pa) {
  const T variance_Pa2 = squared(pressure.resting_drift_Pa_per_sqrt_s) * time_step_s;
  state.unseen_Pa2 += variance_Pa2;
  state.variance_Pa2 = smaller(state.variance_Pa2 + state.liveliness * variance_Pa2, squared(T(0.4) * highest_Pa));
}

/// The pressure difference is seen again: what it did meanwhile tells how lively the supply is.
template <class T>
constexpr void learn_liveliness(const PressureParameters<T>& pressure, PressureState<T>& state, T noise_Pa) {
  if (state.unseen_Pa2 > squared(noise_Pa)) {
    const T change2 = squared(state.pressure_difference_Pa - state.settled_Pa);
    const T shown = smaller(change2 / state.unseen_Pa2, T(1));
    const T pace = shown > state.liveliness ? T(0.5) : T(0.2);
    state.liveliness =
        limited(state.liveliness + pace * (shown - state.liveliness), squared(pressure.least_liveliness), T(1));
    state.unseen_Pa2 = T(0);
  }
  if (state.unseen_Pa2 == T(0)) state.settled_Pa = state.pressure_difference_Pa;
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

/// Moves the pressure difference by its share in what brings the force back into what friction at rest can explain;
/// returns the force left to the other explanation, friction.
template <class T>
constexpr T yield(PressureState<T>& state, const ForceSurprise<T>& beyond, T yielding_s, T time_step_s) {
  const T believed2 = squared(beyond.slope_N_per_Pa) * state.variance_Pa2;
  const T share = believed2 / (believed2 + squared(beyond.noise_N));
  const T force_N = smaller(time_step_s / yielding_s, T(1)) * beyond.force_N;
  state.pressure_difference_Pa += share * force_N / beyond.slope_N_per_Pa;
  return (T(1) - share) * force_N;
}

static_assert(std::is_trivially_copyable_v<PressureState<float>>);

}  // namespace spoolflow::sensor
