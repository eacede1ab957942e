#pragma once
/// The hidden state: the pressure difference over the metering edge. Position is measured, so a flow change that the
/// spool causes costs no lag; only a pressure change must be found through the forces. Friction in operation over that
/// on the bench is found with it: a wrong ratio shows as a pressure difference that jumps whenever the spool turns
/// round. Kalman filter with two states. Each kind of evidence updates them in a file of its own (sliding_evidence.hpp,
/// breakaway_evidence.hpp, rest_evidence.hpp, closed_evidence.hpp); pressure_update.hpp picks the one that a sample
/// gives.
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// Estimate before the first sample, and its standard deviation, as shares of the highest pressure difference.
inline constexpr double first_pressure_share = 0.275;
inline constexpr double first_deviation_share = 0.25;
/// The standard deviation grows up to this share of the highest pressure difference: more says no more.
inline constexpr double most_deviation_share = 1.0 / 3;
/// Average of the normalised innovations squared where the band is as wide as its parts say. Less than 1, since most of
/// the force errors are common to many samples and taken up by the pressure difference.
inline constexpr double usual_innovation_squared = 0.3;
/// Innovations beyond so many standard deviations open the variance: the pressure has changed, ...
inline constexpr double innovation_gate = 1.2;
/// ... at this pace [s].
inline constexpr double gate_opening_s = 0.015;
/// The forces show a change of the pressure difference so much later [s]: what it did since is unobserved at any time.
inline constexpr double measurement_delay_s = 0.002;
/// A variance that reaches this [Pa2], or falls below zero, is invalid: rounding has broken the estimate.
inline constexpr double most_variance_Pa2 = 1e30;
/// Friction grows with pressure against the flow force when the spool closes: what is left of the slope of both
/// together is taken for no less than this share of the flow force's.
inline constexpr double least_slope_share = 0.3;

/// How the pressure difference and the friction ratio may move.
template <class T>
struct PressureParameters {
  T sliding_drift_Pa_per_sqrt_s{};  ///< random walk while the spool slides and the forces show every change
  T resting_drift_Pa_per_sqrt_s{};  ///< random walk while it is unobserved, of the most restless supply
  T least_process_noise{};          ///< share of that drift's variance where the supply has proved steady, (0, 1]
  T first_process_noise{};          ///< the same of a supply of which nothing is known yet
  T constrained_correction_s{};     ///< time constant of the correction by a force that friction at rest cannot explain
  T force_correlation_s{};  ///< for how long errors of the forces stay alike: samples within are no new evidence
  T ratio_deviation{};      ///< standard deviation of the friction ratio at any time
  T ratio_memory_s{};       ///< of sliding, in which it forgets what it has learnt
};

/// How far the pressure difference may lie from the estimate [Pa].
template <class T>
struct PressureHalfWidths {
  T below_Pa{};  ///< >= 0
  T above_Pa{};  ///< >= 0
  T bias_Pa{};   ///< so far above it is expected; below it where < 0
};

template <class T>
struct PressureState {
  T pressure_difference_Pa{};
  T variance_Pa2{};
  T friction_ratio{};  ///< friction in operation over the bench's
  T ratio_variance{};
  T covariance_Pa{};              ///< of pressure difference and friction ratio
  T process_noise{};              ///< variance of unobserved changes over that of the resting drift
  T observed_Pa{};                ///< when last observed; < 0 before
  T drift_variance_Pa2{};         ///< of the resting drift since
  T unobserved_variance_Pa2{};    ///< what of it no force has shown yet
  T breakaway_Pa{};               ///< what all break-away forces together may have it off by, one standard deviation
  T constrained_correction_Pa{};  ///< at rest, by forces that friction cannot explain; one way, since last observed
  T innovation_squared{};         ///< normalised, averaged over the last seconds of sliding
  T band_factor{};                ///< how much wider than its parts say the band must be
  PressureHalfWidths<T> half_widths{};  ///< as it was when it was last computed
};

static_assert(std::is_trivially_copyable_v<PressureState<float>>);

/// Whether the estimate stands at the highest pressure difference that is answered: how far above it the truth lies is
/// not known.
template <class T>
constexpr bool is_capped(const PressureState<T>& state, T highest_Pa) {
  return !lies_below(state.pressure_difference_Pa, highest_Pa);
}

/// What the force balance leaves unexplained, as a measurement of the pressure difference.
template <class T>
struct ForceInnovation {
  T force_N;         ///< > 0 asks for more flow force
  T slope_N_per_Pa;  ///< of the force that is explained over pressure difference
  T ratio_slope_N;   ///< of the same over the friction ratio
  T noise_N;         ///< one standard deviation
};

/// Slope of flow force and friction together over the pressure difference, where both move with it.
template <class T>
SPOOLFLOW_INLINE constexpr T whole_slope_N_per_Pa(T slope_N_per_Pa, T friction_slope_N_per_Pa) {
  return larger(slope_N_per_Pa + friction_slope_N_per_Pa, T(least_slope_share) * slope_N_per_Pa);
}

/// To be called before the first sample, and where the estimate is broken. `calibrated_ratio` is the friction ratio to
/// begin with, `unobserved_factor` that of unobserved_change_Pa.
template <class T>
constexpr void begin(const PressureParameters<T>& pressure, PressureState<T>& state, T highest_Pa, T calibrated_ratio,
                     T unobserved_factor) {
  state.pressure_difference_Pa = T(first_pressure_share) * highest_Pa;
  state.variance_Pa2 = squared(T(first_deviation_share) * highest_Pa);
  state.covariance_Pa = T(0);
  state.process_noise = pressure.first_process_noise;
  state.observed_Pa = T(-1);
  state.drift_variance_Pa2 = T(0);
  state.unobserved_variance_Pa2 = state.variance_Pa2 / squared(unobserved_factor * pressure.first_process_noise);
  state.breakaway_Pa = T(0);
  state.constrained_correction_Pa = T(0);
  state.friction_ratio = calibrated_ratio;
  state.ratio_variance = squared(pressure.ratio_deviation);
  state.innovation_squared = T(usual_innovation_squared);
  state.band_factor = T(1);
  state.half_widths = {highest_Pa, highest_Pa, T(0)};
}

/// Whether an update came to what is no variance: forces that are many orders of magnitude beyond their noise leave
/// nothing but rounding of it. NaN, too.
template <class T>
constexpr bool broken(const PressureState<T>& state) {
  return !within(state.variance_Pa2, T(most_variance_Pa2));
}

/// By how much the friction ratio was found to differ from the calibrated one, beyond what is expected of it at any
/// time.
template <class T>
SPOOLFLOW_INLINE constexpr T displaced_ratio(const PressureParameters<T>& pressure, const PressureState<T>& state,
                                             T calibrated_ratio) {
  return at_least_zero(magnitude(state.friction_ratio - calibrated_ratio) - pressure.ratio_deviation);
}

/// Prediction while no force shows the pressure difference: as restless as the supply has shown itself.
template <class T>
constexpr void drift_unobserved(const PressureParameters<T>& pressure, PressureState<T>& state, T time_step_s,
                                T highest_Pa) {
  const T variance_Pa2 = squared(pressure.resting_drift_Pa_per_sqrt_s) * time_step_s;
  state.drift_variance_Pa2 += variance_Pa2;
  state.unobserved_variance_Pa2 += variance_Pa2;
  if (state.variance_Pa2 < squared(T(most_deviation_share) * highest_Pa))
    state.variance_Pa2 += state.process_noise * variance_Pa2;
}

/// One standard deviation of what the pressure difference may have done unobserved [Pa]. In proportion to the process
/// noise, which is a ratio of variances, not to its root: a restless supply leaps, and leaps are more often large than
/// those of a random walk.
template <class T>
constexpr T unobserved_change_Pa(const PressureState<T>& state, T unobserved_factor) {
  return unobserved_factor * state.process_noise * sqrt(state.unobserved_variance_Pa2);
}

/// Kalman's terms of one innovation.
template <class T>
struct KalmanUpdate {
  T innovation_N;
  T gain_Pa_per_N;       ///< on the pressure difference
  T covariance_N_Pa;     ///< of innovation and pressure difference
  T ratio_covariance_N;  ///< of innovation and friction ratio
  T innovation_variance_N2;
  T remaining_share;  ///< of the prior deviation, left after it
};

/// Weighs an innovation against the prior. Where its test ratio exceeds 1 the variance is opened at the pace of
/// `time_step_s`, to no more than drift opens it: what no pressure difference could explain, friction must.
template <class T>
constexpr KalmanUpdate<T> weigh(PressureState<T>& state, const ForceInnovation<T>& innovation, T noise_N2,
                                T time_step_s, T highest_Pa) {
  const T slope = innovation.slope_N_per_Pa;
  T with_pressure = state.variance_Pa2 * slope + state.covariance_Pa * innovation.ratio_slope_N;
  const T with_ratio = state.covariance_Pa * slope + state.ratio_variance * innovation.ratio_slope_N;
  T prior_N2 = slope * with_pressure + innovation.ratio_slope_N * with_ratio;
  const T excess2 =
      squared(innovation.force_N) * T(1 / (innovation_gate * innovation_gate)) - prior_N2 - squared(innovation.noise_N);
  if (excess2 > T(0)) {
    const T room_Pa2 = squared(T(most_deviation_share) * highest_Pa) - state.variance_Pa2;
    const T opened_N2 = excess2 * smaller(time_step_s / T(gate_opening_s), T(1));
    const T opened_Pa2 = smaller(opened_N2 / squared(slope), room_Pa2);
    state.variance_Pa2 += opened_Pa2;
    with_pressure += opened_Pa2 * slope;
    prior_N2 += opened_Pa2 * squared(slope);
  }
  const T variance2 = prior_N2 + noise_N2;
  const T gain_Pa_per_N = with_pressure / variance2;
  return {innovation.force_N, gain_Pa_per_N, with_pressure, with_ratio, variance2, T(1) - gain_Pa_per_N * slope};
}

/// A smaller pressure difference by a break-away error [Pa] counts as zero: shares of shares become denormal.
inline constexpr double vanishing_breakaway_Pa = 1;

/// The posterior of the pressure difference.
template <class T>
constexpr void correct_pressure(const PressureParameters<T>& pressure, PressureState<T>& state,
                                const KalmanUpdate<T>& update, T highest_Pa) {
  const T corrected_Pa = state.pressure_difference_Pa + update.gain_Pa_per_N * update.innovation_N;
  state.pressure_difference_Pa = from_zero_to(highest_Pa, corrected_Pa);
  const T breakaway_Pa = update.remaining_share * state.breakaway_Pa;
  state.breakaway_Pa = magnitude(breakaway_Pa) > T(vanishing_breakaway_Pa) ? breakaway_Pa : T(0);
  state.constrained_correction_Pa = T(0);
  state.variance_Pa2 -= update.gain_Pa_per_N * update.covariance_N_Pa;
  state.covariance_Pa -= update.gain_Pa_per_N * update.ratio_covariance_N;
  state.unobserved_variance_Pa2 = larger(squared(pressure.resting_drift_Pa_per_sqrt_s) * T(measurement_delay_s),
                                         state.unobserved_variance_Pa2 * squared(update.remaining_share));
}

}  // namespace spoolflow::sensor
