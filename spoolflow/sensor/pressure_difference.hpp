#pragma once
/// The hidden state: the pressure difference over the metering edge. Position is measured, so a flow change that the
/// spool causes costs no lag; only a pressure change must be found through the forces. Friction in operation over that
/// on the bench is found with it: a wrong ratio shows as a pressure difference that jumps whenever the spool turns
/// round. Kalman filter with two states; what a force balance tells them stands in pressure_update.hpp.
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/compiler.hpp"
#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// Belief before the first sample, and its standard deviation, as shares of the highest pressure difference.
inline constexpr double first_pressure_share = 0.275;
inline constexpr double first_deviation_share = 0.25;
/// The standard deviation grows up to this share of the highest pressure difference: more says no more.
inline constexpr double most_deviation_share = 1.0 / 3;
/// Normalised innovations squared are averaged over so much sliding [s].
inline constexpr double innovation_averaging_s = 5;
/// Their average where the band is as wide as its parts tell. Less than 1, since most of what they tell is common to
/// many samples and taken up by the pressure difference.
inline constexpr double usual_innovation_squared = 0.3;
/// The band becomes narrower or wider than its parts tell by no more than these factors.
inline constexpr double least_band_factor = 0.7;
inline constexpr double most_band_factor = 2.5;
/// Innovations beyond so many standard deviations open the variance: the pressure has changed, ...
inline constexpr double innovation_gate = 1.2;
/// ... at this pace [s].
inline constexpr double gate_opening_s = 0.015;
/// Friction in operation over that on the bench lies between these; dither may all but free the spool.
inline constexpr double least_friction_ratio = 0.05;
inline constexpr double most_friction_ratio = 2.5;
/// The pressure difference counts as seen where it is known to this share of what the forces' noise makes of it.
inline constexpr double seen_deviation_share = 0.5;
/// How fast the process noise follows what an observed change shows, where it is more than thought, and where less.
inline constexpr double process_noise_rise = 0.8;
inline constexpr double process_noise_fall = 0.2;
/// When the pressure difference is first seen, nothing is known yet of how it moves: no less process noise than this.
inline constexpr double first_seen_process_noise = 0.2;
/// A change tells half of that where its drift variance is so many times the variance of the forces' noise.
inline constexpr double telling_drift_share = 5;
/// The forces tell of a change of the pressure difference so much later [s]: what it did since is unobserved at any
/// time.
inline constexpr double told_late_s = 0.002;
/// A variance that reaches this [Pa2], or falls below zero, is none: rounding has broken the belief.
inline constexpr double most_variance_Pa2 = 1e30;

/// A smaller covariance of pressure difference and friction ratio [Pa] is none; its square would be no normal number.
inline constexpr double least_covariance_Pa = 1e-3;

/// How the pressure difference and the friction ratio are believed to move.
template <class T>
struct PressureParameters {
  T sliding_drift_Pa_per_sqrt_s{};  ///< random walk while the spool slides and every newton tells
  T resting_drift_Pa_per_sqrt_s{};  ///< random walk while nobody sees it, of the most restless supply
  T least_process_noise{};          ///< share of that drift's variance where the supply has proved steady, (0, 1]
  T first_process_noise{};          ///< the same of a supply of which nothing is known yet
  T yielding_s{};                   ///< how fast it gives way to a force that friction at rest cannot explain
  T force_correlation_s{};  ///< for how long errors of the forces stay alike: samples within are no new evidence
  T ratio_deviation{};      ///< standard deviation of the friction ratio at any time
  T ratio_memory_s{};       ///< of sliding, in which it forgets what it has learnt
};

/// How far the pressure difference may lie from the believed one [Pa].
template <class T>
struct PressureReach {
  T below_Pa{};  ///< >= 0
  T above_Pa{};  ///< >= 0
  T ahead_Pa{};  ///< so far above it is expected; below it where < 0
};

template <class T>
struct PressureState {
  T pressure_difference_Pa{};
  T variance_Pa2{};
  T friction_ratio{};  ///< friction in operation over the bench's
  T ratio_variance{};
  T covariance_Pa{};            ///< of pressure difference and friction ratio
  T process_noise{};            ///< variance of unobserved changes over that of the resting drift
  T observed_Pa{};              ///< when last seen; < 0 before
  T drift_variance_Pa2{};       ///< of the resting drift since
  T unobserved_variance_Pa2{};  ///< what of it no force has told of yet
  T yielded_Pa{};               ///< to forces that friction at rest cannot explain, one way, since last seen
  T innovation_squared{};       ///< normalised, averaged over the last seconds of sliding
  T band_factor{};              ///< how much wider than its parts tell the band must be
  PressureReach<T> reach{};     ///< as it was when it was last reckoned
};

static_assert(std::is_trivially_copyable_v<PressureState<float>>);

/// What the force balance leaves unexplained, as a measurement of the pressure difference.
template <class T>
struct ForceInnovation {
  T force_N;         ///< > 0 asks for more flow force
  T slope_N_per_Pa;  ///< of the force that is explained over pressure difference
  T ratio_slope_N;   ///< of the same over the friction ratio
  T noise_N;         ///< one standard deviation
};

/// To be called before the first sample, and where the belief is broken. `calibrated_ratio` is the friction ratio to
/// begin with, `unseen_factor` that of unobserved_change_Pa.
template <class T>
constexpr void begin(const PressureParameters<T>& pressure, PressureState<T>& state, T highest_Pa, T calibrated_ratio,
                     T unseen_factor) {
  state.pressure_difference_Pa = T(first_pressure_share) * highest_Pa;
  state.variance_Pa2 = squared(T(first_deviation_share) * highest_Pa);
  state.covariance_Pa = T(0);
  state.process_noise = pressure.first_process_noise;
  state.observed_Pa = T(-1);
  state.drift_variance_Pa2 = T(0);
  state.unobserved_variance_Pa2 = state.variance_Pa2 / squared(unseen_factor * pressure.first_process_noise);
  state.yielded_Pa = T(0);
  state.friction_ratio = calibrated_ratio;
  state.ratio_variance = squared(pressure.ratio_deviation);
  state.innovation_squared = T(usual_innovation_squared);
  state.band_factor = T(1);
  state.reach = {highest_Pa, highest_Pa, T(0)};
}

/// How much wider than its parts tell the band must be, as the forces have been agreeing: wider under dither or on a
/// supply that leaps, narrower where every sample confirms the one before. The root of the normalised innovation's
/// size, which changes within seconds.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_agreement(PressureState<T>& state) {
  state.band_factor = limited(sqrt(sqrt(state.innovation_squared * (T(1) / T(usual_innovation_squared)))),
                              T(least_band_factor), T(most_band_factor));
}

/// Whether an update came to what is no variance: forces that are many orders of magnitude beyond their noise leave
/// nothing but rounding of it. NaN, too.
template <class T>
constexpr bool broken(const PressureState<T>& state) {
  return !within(state.variance_Pa2, T(most_variance_Pa2));
}

/// Prediction while the spool slides.
template <class T>
constexpr void drift(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s, T highest_Pa) {
  state.variance_Pa2 += state.variance_Pa2 < squared(T(most_deviation_share) * highest_Pa)
                            ? squared(pressure.sliding_drift_Pa_per_sqrt_s) * time_step_s
                            : T(0);
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

/// By how much the friction ratio was found to differ from the calibrated one, beyond what is expected of it at any
/// time.
template <class T>
SPOOLFLOW_INLINE constexpr T displaced_ratio(const PressureParameters<T>& pressure, const PressureState<T>& state,
                                             T calibrated_ratio) {
  return larger(magnitude(state.friction_ratio - calibrated_ratio) - pressure.ratio_deviation, T(0));
}

/// Freed by dither the spool tells nothing of the friction ratio, and the covariance goes to zero by and by.
template <class T>
constexpr void drop_covariance(PressureState<T>& state) {
  if (magnitude(state.covariance_Pa) < T(least_covariance_Pa)) state.covariance_Pa = T(0);
}

/// Prediction while nothing tells: as restless as the supply has shown itself.
template <class T>
constexpr void drift_unseen(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s,
                            T highest_Pa) {
  const T variance_Pa2 = squared(pressure.resting_drift_Pa_per_sqrt_s) * time_step_s;
  state.drift_variance_Pa2 += variance_Pa2;
  state.unobserved_variance_Pa2 += variance_Pa2;
  state.variance_Pa2 +=
      state.variance_Pa2 < squared(T(most_deviation_share) * highest_Pa) ? state.process_noise * variance_Pa2 : T(0);
}

/// Behind a closed valve the supply may do what it likes, however steady it has been.
template <class T>
constexpr void expect_change(const PressureParameters<T>& pressure, PressureState<T>& state) {
  state.process_noise = larger(state.process_noise, pressure.first_process_noise);
}

/// One standard deviation of what the pressure difference may have done unseen [Pa]. In proportion to the process
/// noise, which is a ratio of variances, not to its root: a restless supply leaps, and leaps are more often large than
/// those of a random walk.
template <class T>
constexpr T unobserved_change_Pa(const PressureState<T>& state, T unseen_factor) {
  return unseen_factor * state.process_noise * sqrt(state.unobserved_variance_Pa2);
}

/// The pressure difference is seen again: what it did meanwhile, beyond what the forces' errors make of it, tells the
/// process noise. When first seen it tells nothing yet.
template <class T>
constexpr void learn_process_noise(const PressureParameters<T>& pressure, PressureState<T>& state, T noise_Pa) {
  if (state.observed_Pa < T(0)) {
    state.drift_variance_Pa2 = T(0);
    state.process_noise = larger(state.process_noise, T(first_seen_process_noise));
  }
  if (state.drift_variance_Pa2 > squared(noise_Pa)) {
    const T change2 = squared(state.pressure_difference_Pa - state.observed_Pa);
    const T shown = smaller(
        (change2 - T(seen_deviation_share * seen_deviation_share) * squared(noise_Pa)) / state.drift_variance_Pa2,
        T(1));
    const T weight = state.drift_variance_Pa2 / (state.drift_variance_Pa2 + T(telling_drift_share) * squared(noise_Pa));
    const T pace = weight * (shown > state.process_noise ? T(process_noise_rise) : T(process_noise_fall));
    state.process_noise =
        limited(state.process_noise + pace * (shown - state.process_noise), pressure.least_process_noise, T(1));
    state.drift_variance_Pa2 = T(0);
  }
  if (is_zero(state.drift_variance_Pa2)) state.observed_Pa = state.pressure_difference_Pa;
}

/// Kalman's terms of one innovation.
template <class T>
struct KalmanUpdate {
  T innovation_N;
  T gain_Pa_per_N;       ///< on the pressure difference
  T covariance_N_Pa;     ///< of innovation and pressure difference
  T ratio_covariance_N;  ///< of innovation and friction ratio
  T innovation_variance_N2;
  T remaining_share;  ///< of what was believed before, left after it
};

/// Weighs an innovation against what is believed. Where its test ratio exceeds 1 the variance is opened at the pace of
/// `time_step_s`, to no more than drift opens it: what no pressure difference could explain, friction must.
template <class T>
constexpr KalmanUpdate<T> weigh(PressureState<T>& state, const ForceInnovation<T>& innovation, T noise_N2,
                                T time_step_s, T highest_Pa) {
  const T slope = innovation.slope_N_per_Pa;
  T with_pressure = state.variance_Pa2 * slope + state.covariance_Pa * innovation.ratio_slope_N;
  const T with_ratio = state.covariance_Pa * slope + state.ratio_variance * innovation.ratio_slope_N;
  T believed2 = slope * with_pressure + innovation.ratio_slope_N * with_ratio;
  const T excess2 = squared(innovation.force_N) * T(1 / (innovation_gate * innovation_gate)) - believed2 -
                    squared(innovation.noise_N);
  if (excess2 > T(0)) {
    const T room_Pa2 = squared(T(most_deviation_share) * highest_Pa) - state.variance_Pa2;
    const T opened_N2 = excess2 * smaller(time_step_s / T(gate_opening_s), T(1));
    const T opened_Pa2 = smaller(opened_N2 / squared(slope), room_Pa2);
    state.variance_Pa2 += opened_Pa2;
    with_pressure += opened_Pa2 * slope;
    believed2 += opened_Pa2 * squared(slope);
  }
  const T variance2 = believed2 + noise_N2;
  const T gain_Pa_per_N = with_pressure / variance2;
  return {innovation.force_N, gain_Pa_per_N, with_pressure, with_ratio, variance2, T(1) - gain_Pa_per_N * slope};
}

template <class T>
constexpr void correct_pressure(const PressureParameters<T>& pressure, PressureState<T>& state,
                                const KalmanUpdate<T>& update, T highest_Pa) {
  const T corrected_Pa = state.pressure_difference_Pa + update.gain_Pa_per_N * update.innovation_N;
  state.pressure_difference_Pa = limited(corrected_Pa, T(0), highest_Pa);
  state.yielded_Pa = T(0);
  state.variance_Pa2 -= update.gain_Pa_per_N * update.covariance_N_Pa;
  state.covariance_Pa -= update.gain_Pa_per_N * update.ratio_covariance_N;
  state.unobserved_variance_Pa2 = larger(squared(pressure.resting_drift_Pa_per_sqrt_s) * T(told_late_s),
                                         state.unobserved_variance_Pa2 * squared(update.remaining_share));
}

template <class T>
constexpr void correct_ratio(PressureState<T>& state, const KalmanUpdate<T>& update) {
  const T gain_1_per_N = update.ratio_covariance_N / update.innovation_variance_N2;
  state.friction_ratio = limited(state.friction_ratio + gain_1_per_N * update.innovation_N, T(least_friction_ratio),
                                 T(most_friction_ratio));
  state.ratio_variance -= gain_1_per_N * update.ratio_covariance_N;
}

/// While the spool slides: Kalman update of pressure difference and friction ratio, no matter how often it is sampled.
template <class T>
constexpr void update_sliding(const PressureParameters<T>& pressure, PressureState<T>& state,
                              const ForceInnovation<T>& innovation, T time_step_s, T highest_Pa) {
  // Samples within the correlation of the errors share one piece of evidence; a longer step is still no more than one.
  const T noise_N2 = squared(innovation.noise_N) * larger(pressure.force_correlation_s / time_step_s, T(1));
  const T expected_N2 = squared(innovation.slope_N_per_Pa) * state.variance_Pa2 + squared(innovation.noise_N);
  state.innovation_squared += (squared(innovation.force_N) / expected_N2 - state.innovation_squared) *
                              smaller(time_step_s / T(innovation_averaging_s), T(1));
  const KalmanUpdate<T> update = weigh(state, innovation, noise_N2, time_step_s, highest_Pa);
  correct_ratio(state, update);
  correct_pressure(pressure, state, update, highest_Pa);
}

/// At a break-away: of the pressure difference alone, since stiction says little of sliding friction.
template <class T>
constexpr void update_breakaway(const PressureParameters<T>& pressure, PressureState<T>& state,
                                const ForceInnovation<T>& innovation, T highest_Pa) {
  correct_pressure(pressure, state, weigh(state, innovation, squared(innovation.noise_N), T(0), highest_Pa),
                   highest_Pa);
}

/// Whether the pressure difference, at a given friction ratio, is known better than `noise_N` makes of it.
template <class T>
constexpr bool observed(const PressureState<T>& state, T slope_N_per_Pa, T noise_N) {
  const T variance2 = state.variance_Pa2 * state.ratio_variance - squared(state.covariance_Pa);
  return squared(slope_N_per_Pa) * variance2 <
         T(seen_deviation_share * seen_deviation_share) * squared(noise_N) * state.ratio_variance;
}

/// Moves the pressure difference by its share in what brings the force back into what friction at rest can explain;
/// returns the force left to the other explanation, friction.
template <class T>
constexpr T yield(const PressureParameters<T>& pressure, PressureState<T>& state, const ForceInnovation<T>& beyond,
                  T time_step_s, T highest_Pa) {
  const T believed2 = squared(beyond.slope_N_per_Pa) * state.variance_Pa2;
  const T share = believed2 / (believed2 + squared(beyond.noise_N));
  const T force_N = smaller(time_step_s / pressure.yielding_s, T(1)) * beyond.force_N;
  const T before_Pa = state.pressure_difference_Pa;
  state.pressure_difference_Pa = limited(before_Pa + share * force_N / beyond.slope_N_per_Pa, T(0), highest_Pa);
  const T yields_Pa = state.pressure_difference_Pa - before_Pa;
  state.yielded_Pa = yields_Pa + (yields_Pa * state.yielded_Pa < T(0) ? T(0) : state.yielded_Pa);
  return (T(1) - share) * force_N;
}

}  // namespace spoolflow::sensor
