#pragma once
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// Share of the flux rate that its model may be wrong by: fast changes drive currents in the iron that one stage of
/// eddy currents describes poorly.
inline constexpr double flux_rate_error_share = 1.0 / 3;
/// Variance density of the voltage that is always assumed [V2 s]: the filter divides by it.
inline constexpr double least_voltage_variance_V2s = 1e-12;
/// Resistance over the calibrated one that copper can have, at -60 and at 220 degC where it was calibrated at 40.
inline constexpr double coldest_resistance_ratio = 0.6;
inline constexpr double warmest_resistance_ratio = 1.7;
/// A voltage of more than this share of what holds the largest current, that no current answers: the line or the
/// current's instrument is broken.
inline constexpr double unanswered_voltage_share = 0.1;
/// How well the resistance must be known, as a share of it, before it is called implausible.
inline constexpr double known_resistance_share = 0.1;

/// Voltage, current and flux rate are averaged over this [s]: many periods of dither, whose voltage is several times
/// that over the resistance and follows from a flux rate whose model is poor so fast.
inline constexpr double coil_averaging_s = 0.05;

/// Coil resistance [Ohm], followed while the valve works: the coil warms, copper by 0.39 % per kelvin. It does not
/// enter the force, which comes from the current (docs/accuracy.md, ablation); it shows faults of the coil.
template <class T>
struct CoilResistance {
  T resistance_Ohm{};          ///< as calibrated, where following starts; 0: not known
  T uncertainty_Ohm{};         ///< one standard deviation at the start
  T drift_Ohm_per_root_s{};    ///< how fast it may wander
  T voltage_noise_V_root_s{};  ///< of the voltage about R i + d flux/dt, noise density
};

/// The terms of the coil's equation u = R i + d flux/dt during one sample, or in the mean over many.
template <class T>
struct CoilEquation {
  T current_A{};
  T voltage_V{};
  T flux_rate_V{};
};

/// Estimate and variance of a scalar Kalman filter; {} before the first sample.
template <class T>
struct CoilResistanceState {
  T resistance_Ohm{};
  T variance_Ohm2{};
  CoilEquation<T> mean{};
  T waits_s{};         ///< samples with a voltage since the filter's last step
  bool implausible{};  ///< known well, and not what copper can have
  bool unanswered{};   ///< there is voltage, and no current to go with it: the current is not measured
};

static_assert(std::is_trivially_copyable_v<CoilResistanceState<float>>);

/// One sample, `time_step_s` long. The equation is linear: what holds of each sample holds of their mean, if it is
/// taken of all of them. A voltage that is NaN leaves the mean alone.
template <class T>
SPOOLFLOW_INLINE constexpr void average(CoilResistanceState<T>& state, const CoilEquation<T>& sample, T time_step_s) {
  if (is_number(sample.voltage_V)) {
    state.waits_s += time_step_s;
    const T share = smaller(time_step_s * T(1 / coil_averaging_s), T(1));
    state.mean.current_A += share * (sample.current_A - state.mean.current_A);
    state.mean.voltage_V += share * (sample.voltage_V - state.mean.voltage_V);
    state.mean.flux_rate_V += share * (sample.flux_rate_V - state.mean.flux_rate_V);
  }
}

/// One step of the Kalman filter for all samples since its last one: the resistance drifts for as long as they last,
/// and they are so much evidence and no more, so that it does not matter that the next mean is much alike. Informative
/// where current flows, whether steady or not; a coil whose resistance was never calibrated leaves the estimate alone.
template <class T>
constexpr void follow_resistance(const CoilResistance<T>& coil, CoilResistanceState<T>& state) {
  const T since_s = state.waits_s;
  state.waits_s = T(0);
  if (coil.resistance_Ohm > T(0) && since_s > T(0)) {
    const CoilEquation<T>& mean = state.mean;
    const bool begins = is_zero(state.variance_Ohm2);
    if (begins) state.resistance_Ohm = coil.resistance_Ohm;
    if (begins) state.variance_Ohm2 = squared(coil.uncertainty_Ohm);
    state.variance_Ohm2 += squared(coil.drift_Ohm_per_root_s) * since_s;
    const T misfit_V = mean.voltage_V - mean.flux_rate_V - state.resistance_Ohm * mean.current_A;
    const T covariance = state.variance_Ohm2 * mean.current_A;
    const T noise2 = squared(coil.voltage_noise_V_root_s) +
                     squared(T(flux_rate_error_share) * mean.flux_rate_V) * since_s + T(least_voltage_variance_V2s);
    const T gain = covariance * since_s / (covariance * mean.current_A * since_s + noise2);
    state.resistance_Ohm += gain * misfit_V;
    state.variance_Ohm2 -= gain * covariance;
    state.implausible = state.variance_Ohm2 < squared(T(known_resistance_share) * coil.resistance_Ohm) &&
                        (state.resistance_Ohm < T(coldest_resistance_ratio) * coil.resistance_Ohm ||
                         state.resistance_Ohm > T(warmest_resistance_ratio) * coil.resistance_Ohm);
  }
}

/// Whether the mean voltage is more than any coil's resistance makes of the mean current, and `quiet_V` (>= 0) beside.
template <class T>
constexpr void judge_answer(const CoilResistance<T>& coil, CoilResistanceState<T>& state, T quiet_V) {
  const CoilEquation<T>& mean = state.mean;
  const T answered_V = T(warmest_resistance_ratio) * coil.resistance_Ohm * magnitude(mean.current_A) + quiet_V +
                       T(flux_rate_error_share) * magnitude(mean.flux_rate_V);
  state.unanswered = coil.resistance_Ohm > T(0) && magnitude(mean.voltage_V - mean.flux_rate_V) > answered_V;
}

}  // namespace spoolflow::sensor
