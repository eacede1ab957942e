#pragma once
/// While the spool slides friction has its full size and the sign of the velocity: each sample measures the pressure
/// difference, and in both directions of motion friction in operation over the bench's. How well samples agree sets the
/// width of the band, and how far the pressure difference was found to have moved sets the process noise.
#include "spoolflow/sensor/basis/due.hpp"
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"

namespace spoolflow::sensor {

/// Normalised innovations squared are averaged over so much sliding [s].
inline constexpr double innovation_averaging_s = 5;
/// The band becomes narrower or wider than its parts say by no more than these factors.
inline constexpr double least_band_factor = 0.7;
inline constexpr double most_band_factor = 2.5;
/// The pressure difference counts as observed where it is known to this share of what the forces' noise makes of it.
inline constexpr double observed_deviation_share = 0.5;
/// How fast the process noise follows what an observed change shows, where it is larger than expected, and where
/// smaller.
inline constexpr double process_noise_rise = 0.8;
inline constexpr double process_noise_fall = 0.2;
/// When the pressure difference is first observed, its changes are not known yet: no less process noise than this.
inline constexpr double first_observed_process_noise = 0.2;
/// A change counts half where its drift variance is so many times the variance of the forces' noise.
inline constexpr double informative_drift_share = 5;
/// A smaller covariance of pressure difference and friction ratio [Pa] counts as zero: its square would be denormal.
inline constexpr double least_covariance_Pa = 1e-3;
/// Friction in operation over that on the bench lies between these; dither may all but free the spool.
inline constexpr double least_friction_ratio = 0.05;
inline constexpr double most_friction_ratio = 2.5;

/// Prediction over one sample.
template <class T>
constexpr void drift(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s, T highest_Pa) {
  if (state.variance_Pa2 < squared(T(most_deviation_share) * highest_Pa))
    state.variance_Pa2 += squared(pressure.sliding_drift_Pa_per_sqrt_s) * time_step_s;
}

/// The friction ratio goes back towards the calibrated one: it was found where the spool was, and at its speed.
template <class T>
constexpr void forget_ratio(const PressureParameters<T>& pressure, PressureState<T>& state, T calibrated_ratio,
                            T time_step_s) {
  const T share = smaller(time_step_s / pressure.ratio_memory_s, T(1));
  state.friction_ratio += share * (calibrated_ratio - state.friction_ratio);
  state.covariance_Pa -= share * state.covariance_Pa;
  state.ratio_variance += T(2) * share * (squared(pressure.ratio_deviation) - state.ratio_variance);
}

/// How much wider than its parts say the band must be, as the forces have been agreeing: wider under dither or on a
/// supply that leaps, narrower where every sample confirms the one before. The root of the normalised innovation's
/// size, which changes within seconds.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_agreement(PressureState<T>& state) {
  state.band_factor = limited(sqrt(sqrt(state.innovation_squared * (T(1) / T(usual_innovation_squared)))),
                              T(least_band_factor), T(most_band_factor));
}

/// The innovation of one sample.
template <class T>
SPOOLFLOW_INLINE constexpr ForceInnovation<T> sliding_innovation(const ForceBalance<T>& balance, T friction_ratio) {
  return {balance.residual_force_N - balance.friction_N,
          whole_slope_N_per_Pa(balance.edge.flow_force_per_pressure_N_Pa,
                               balance.direction * (friction_ratio * balance.edge.friction_per_pressure_N_Pa)),
          balance.direction * (balance.edge.friction_N + balance.actuator.friction_half_width_N), balance.noise_N};
}

namespace detail {

template <class T>
constexpr void correct_ratio(PressureState<T>& state, const KalmanUpdate<T>& update) {
  const T gain_1_per_N = update.ratio_covariance_N / update.innovation_variance_N2;
  state.friction_ratio = limited(state.friction_ratio + gain_1_per_N * update.innovation_N, T(least_friction_ratio),
                                 T(most_friction_ratio));
  state.ratio_variance -= gain_1_per_N * update.ratio_covariance_N;
}

}  // namespace detail

/// Kalman update of pressure difference and friction ratio, no matter how often it is sampled.
template <class T>
constexpr void update_sliding(const PressureParameters<T>& pressure, PressureState<T>& state,
                              const ForceInnovation<T>& innovation, T time_step_s, T highest_Pa) {
  // Samples within the correlation of the errors share one piece of evidence; a longer step is still no more than one.
  const T noise_N2 = squared(innovation.noise_N) * larger(pressure.force_correlation_s / time_step_s, T(1));
  const T expected_N2 = squared(innovation.slope_N_per_Pa) * state.variance_Pa2 + squared(innovation.noise_N);
  state.innovation_squared += (squared(innovation.force_N) / expected_N2 - state.innovation_squared) *
                              smaller(time_step_s / T(innovation_averaging_s), T(1));
  const KalmanUpdate<T> update = weigh(state, innovation, noise_N2, time_step_s, highest_Pa);
  detail::correct_ratio(state, update);
  correct_pressure(pressure, state, update, highest_Pa);
}

/// Whether the pressure difference, at a given friction ratio, is known better than `noise_N` makes of it.
template <class T>
constexpr bool observed(const PressureState<T>& state, T slope_N_per_Pa, T noise_N) {
  const T variance2 = state.variance_Pa2 * state.ratio_variance - squared(state.covariance_Pa);
  return squared(slope_N_per_Pa) * variance2 <
         T(observed_deviation_share * observed_deviation_share) * squared(noise_N) * state.ratio_variance;
}

/// The pressure difference is observed again: how far it moved meanwhile, beyond what the forces' errors make of it,
/// shows the process noise. When it is first observed it shows nothing yet.
template <class T>
constexpr void learn_process_noise(const PressureParameters<T>& pressure, PressureState<T>& state, T noise_Pa) {
  if (state.observed_Pa < T(0)) {
    state.drift_variance_Pa2 = T(0);
    state.process_noise = larger(state.process_noise, T(first_observed_process_noise));
  }
  if (state.drift_variance_Pa2 > squared(noise_Pa)) {
    const T change2 = squared(state.pressure_difference_Pa - state.observed_Pa);
    const T shown = smaller((change2 - T(observed_deviation_share * observed_deviation_share) * squared(noise_Pa)) /
                                state.drift_variance_Pa2,
                            T(1));
    const T weight =
        state.drift_variance_Pa2 / (state.drift_variance_Pa2 + T(informative_drift_share) * squared(noise_Pa));
    const T pace = weight * (shown > state.process_noise ? T(process_noise_rise) : T(process_noise_fall));
    state.process_noise =
        limited(state.process_noise + pace * (shown - state.process_noise), pressure.least_process_noise, T(1));
    state.drift_variance_Pa2 = T(0);
  }
  if (is_zero(state.drift_variance_Pa2)) state.observed_Pa = state.pressure_difference_Pa;
}

/// The slow part of a sample's evidence. Freed by dither the spool shows nothing of the friction ratio, and the
/// covariance goes to zero by and by.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_process_noise(const PressureParameters<T>& pressure, PressureState<T>& state,
                                                     T slope_N_per_Pa, T noise_N) {
  if (magnitude(state.covariance_Pa) < T(least_covariance_Pa)) state.covariance_Pa = T(0);
  if (observed(state, slope_N_per_Pa, noise_N)) learn_process_noise(pressure, state, noise_N / slope_N_per_Pa);
}

}  // namespace spoolflow::sensor
