#pragma once
/// The hidden state: the pressure difference over the metering edge. Position is measured, so a flow change that the
/// spool causes costs no lag; only a pressure change must be found through the forces. Friction in operation over that
/// on the bench is found with it: a wrong ratio shows as a pressure difference that jumps whenever the spool turns
/// round.
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// How the pressure difference and the friction ratio are believed to move.
template <class T>
struct PressureParameters {
  T sliding_drift_Pa_per_sqrt_s{};  ///< random walk while the spool slides and every newton tells
  T resting_drift_Pa_per_sqrt_s{};  ///< random walk while nobody sees it, where the supply is at its liveliest
  T least_liveliness{};             ///< share of that drift where the supply has proved steady, (0, 1]
  T first_liveliness{};             ///< the same, of a supply of which nothing is known yet
  T yielding_s{};                   ///< how fast it gives way to a force that friction at rest cannot explain
  T force_correlation_s{};  ///< for how long errors of the forces stay alike: samples within are no new evidence
  T ratio_deviation{};      ///< standard deviation of the friction ratio at any time
  T ratio_memory_s{};       ///< of sliding, in which it forgets what it has learnt
};

template <class T>
struct PressureState {
  T pressure_difference_Pa{};
  T variance_Pa2{};
  T friction_ratio{};  ///< friction in operation over the bench's
  T ratio_variance{};
  T covariance_Pa{};  ///< of pressure difference and friction ratio
  T liveliness{};     ///< variance of unseen changes over that of the resting drift
  T settled_Pa{};     ///< when last seen
  T unseen_Pa2{};     ///< variance that has built up since, at full liveliness
  T doubt_Pa2{};      ///< what of it no force has told of yet
  T innovation{};     ///< squared over its expected variance, averaged over the last seconds of sliding
};

/// The averaged innovation of a sensor whose band is as wide as its parts tell. Less than 1, since most of what they
/// tell is common to many samples and taken up by the pressure difference.
inline constexpr double usual_innovation = 0.3;

/// A force balance as a measurement of the pressure difference.
template <class T>
struct ForceSurprise {
  T force_N;         ///< what the believed pressure difference leaves unexplained, > 0 asks for more flow force
  T slope_N_per_Pa;  ///< of the force that is explained over pressure difference
  T ratio_slope_N;   ///< of the same over the friction ratio
  T noise_N;         ///< one standard deviation
};

template <class T>
constexpr void drift(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s, T highest_Pa) {
  state.variance_Pa2 += select(state.variance_Pa2 < squared(T(0.4) * highest_Pa),
                               squared(pressure.sliding_drift_Pa_per_sqrt_s) * time_step_s, T(0));
}

/// The friction ratio goes back towards what was calibrated: it has learnt where the spool was, and at what speed.
template <class T>
constexpr void forget_ratio(const PressureParameters<T>& pressure, PressureState<T>& state, T calibrated_ratio,
                            T time_step_s) {
  const T share = smaller(time_step_s / pressure.ratio_memory_s, T(1));
  state.friction_ratio += share * (calibrated_ratio - state.friction_ratio);
  state.covariance_Pa -= share * state.covariance_Pa;
  state.ratio_variance += T(2) * share * (squared(pressure.ratio_deviation) - state.ratio_variance);
}

/// The same while nothing tells: as lively as the supply has shown itself.
template <class T>
constexpr void drift_unseen(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s,
                            T highest_Pa) {
  const T variance_Pa2 = squared(pressure.resting_drift_Pa_per_sqrt_s) * time_step_s;
  state.unseen_Pa2 += variance_Pa2;
  state.doubt_Pa2 += variance_Pa2;
  state.variance_Pa2 +=
      select(state.variance_Pa2 < squared(T(0.4) * highest_Pa), state.liveliness * variance_Pa2, T(0));
}

/// Behind a closed valve the supply may do what it likes, however steady it has been.
template <class T>
constexpr void expect_change(const PressureParameters<T>& pressure, PressureState<T>& state) {
  state.liveliness = larger(state.liveliness, pressure.first_liveliness);
}

/// One standard deviation of what the pressure difference may have done unseen [Pa]. In proportion to the liveliness,
/// not to its root: a lively supply leaps, and leaps are more often large than those of a random walk.
template <class T>
constexpr T unseen_change_Pa(const PressureState<T>& state, T unseen_factor) {
  return unseen_factor * state.liveliness * sqrt(state.doubt_Pa2);
}

/// The pressure difference is seen again: what it did meanwhile, beyond what the forces' errors make of it, tells how
/// lively the supply is.
template <class T>
constexpr void learn_liveliness(const PressureParameters<T>& pressure, PressureState<T>& state, T noise_Pa) {
  in_valves(state.unseen_Pa2 > squared(noise_Pa), state, [&] {
    const T change2 = squared(state.pressure_difference_Pa - state.settled_Pa);
    const T shown = smaller((change2 - T(0.25) * squared(noise_Pa)) / state.unseen_Pa2, T(1));
    const T pace = select(shown > state.liveliness, T(0.8), T(0.2));
    state.liveliness =
        limited(state.liveliness + pace * (shown - state.liveliness), squared(pressure.least_liveliness), T(1));
    state.unseen_Pa2 = T(0);
  });
  state.settled_Pa = select(state.unseen_Pa2 == T(0), state.pressure_difference_Pa, state.settled_Pa);
}

/// What a surprise says of the pressure difference, in the sense of Kalman.
template <class T>
struct Correction {
  T force_N;          ///< of the surprise
  T gain_Pa_per_N;    ///< on the pressure difference
  T covariance_N_Pa;  ///< of surprise and pressure difference
  T covariance_N;     ///< of surprise and friction ratio
  T variance_N2;      ///< of the surprise
  T unseen_share;     ///< of what was believed before, left after it
};

/// A surprise beyond three standard deviations opens the variance at the pace of `time_step_s`: the pressure has
/// changed.
template <class T>
constexpr Correction<T> correction(PressureState<T>& state, const ForceSurprise<T>& surprise, T noise_N2,
                                   T time_step_s) {
  const T slope = surprise.slope_N_per_Pa;
  T with_pressure = state.variance_Pa2 * slope + state.covariance_Pa * surprise.ratio_slope_N;
  const T with_ratio = state.covariance_Pa * slope + state.ratio_variance * surprise.ratio_slope_N;
  T believed2 = slope * with_pressure + surprise.ratio_slope_N * with_ratio;
  const T excess2 = squared(surprise.force_N) * T(1.0 / 9) - believed2 - squared(surprise.noise_N);
  const T opening_s = T(0.05);
  const Truth<T> exceeds = excess2 > T(0);
  if (any(exceeds)) {
    const T opened2 = select(exceeds, excess2 * smaller(time_step_s / opening_s, T(1)), T(0));
    state.variance_Pa2 += opened2 / squared(slope);
    with_pressure += opened2 / slope;
    believed2 += opened2;
  }
  const T variance2 = believed2 + noise_N2;
  const T gain_Pa_per_N = with_pressure / variance2;
  return {surprise.force_N, gain_Pa_per_N, with_pressure, with_ratio, variance2, T(1) - gain_Pa_per_N * slope};
}

template <class T>
constexpr void correct_pressure(PressureState<T>& state, const Correction<T>& told) {
  state.pressure_difference_Pa += told.gain_Pa_per_N * told.force_N;
  state.variance_Pa2 -= told.gain_Pa_per_N * told.covariance_N_Pa;
  state.covariance_Pa -= told.gain_Pa_per_N * told.covariance_N;
  // Not below a pascal: while the spool slides on it would fade into denormal numbers, which some cores are slow with.
  state.doubt_Pa2 = larger(state.doubt_Pa2 * squared(told.unseen_share), T(1));
}

/// While the spool slides: Kalman update of pressure difference and friction ratio, no matter how often it is sampled.
template <class T>
constexpr void update_sliding(const PressureParameters<T>& pressure, PressureState<T>& state,
                              const ForceSurprise<T>& surprise, T time_step_s) {
  const T noise_N2 = squared(surprise.noise_N) * (pressure.force_correlation_s / time_step_s);
  const T averaging_s = T(5);
  const T expected_N2 = squared(surprise.slope_N_per_Pa) * state.variance_Pa2 + squared(surprise.noise_N);
  state.innovation +=
      (squared(surprise.force_N) / expected_N2 - state.innovation) * smaller(time_step_s / averaging_s, T(1));
  const Correction<T> told = correction(state, surprise, noise_N2, time_step_s);
  const T ratio_gain_1_per_N = told.covariance_N / told.variance_N2;
  const T least = T(0.05);  // dither may all but free the spool
  const T most = T(2.5);
  state.friction_ratio = limited(state.friction_ratio + ratio_gain_1_per_N * told.force_N, least, most);
  state.ratio_variance -= ratio_gain_1_per_N * told.covariance_N;
  correct_pressure(state, told);
}

/// At a break-away: of the pressure difference alone, since stiction says little of sliding friction.
template <class T>
constexpr void update_breakaway(PressureState<T>& state, const ForceSurprise<T>& surprise) {
  correct_pressure(state, correction(state, surprise, squared(surprise.noise_N), T(0)));
}

/// How much wider than its parts tell the band must be, as the forces have been agreeing: wider under dither or on a
/// supply that leaps, narrower where every sample confirms the one before.
template <class T>
constexpr T band_factor(const PressureState<T>& state) {
  return limited(sqrt(sqrt(state.innovation * (T(1) / T(usual_innovation)))), T(0.35), T(2.5));
}

/// Whether the pressure difference, at a given friction ratio, is known to better than half of `noise_N`.
template <class T>
constexpr Truth<T> settled(const PressureState<T>& state, T slope_N_per_Pa, T noise_N) {
  const T variance2 = state.variance_Pa2 * state.ratio_variance - squared(state.covariance_Pa);
  return squared(slope_N_per_Pa) * variance2 < T(0.25) * squared(noise_N) * state.ratio_variance;
}

/// Moves the pressure difference by its share in what brings the force back into what friction at rest can explain;
/// returns the force left to the other explanation, friction.
template <class T>
constexpr T yield(const PressureParameters<T>& pressure, PressureState<T>& state, const ForceSurprise<T>& beyond,
                  T time_step_s) {
  const T believed2 = squared(beyond.slope_N_per_Pa) * state.variance_Pa2;
  const T share = believed2 / (believed2 + squared(beyond.noise_N));
  const T force_N = smaller(time_step_s / pressure.yielding_s, T(1)) * beyond.force_N;
  state.pressure_difference_Pa += share * force_N / beyond.slope_N_per_Pa;
  return (T(1) - share) * force_N;
}

static_assert(std::is_trivially_copyable_v<PressureState<float>>);

}  // namespace spoolflow::sensor
