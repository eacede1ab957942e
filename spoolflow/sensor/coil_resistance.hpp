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
/// A mean current of less than this share of the largest says nothing of the resistance: it may be the zero of its
/// instrument.
inline constexpr double resistance_current_share = 0.02;
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
  CoilEquation<T> collected{};  ///< its terms times time [A s, V s, Wb] of the samples that the mean has not taken up
  T collected_s{};              ///< how long these samples are, all with a voltage
  bool implausible{};           ///< known well, and not what copper can have
  bool unanswered{};            ///< there is voltage, and no current to go with it: the current is not measured
};

static_assert(std::is_trivially_copyable_v<CoilResistanceState<float>>);

/// A voltage counts as the mean over a sample where samples are no further apart [s].
inline constexpr double longest_voltage_mean_s = 2.5e-3;
/// The voltage [V] that drives a coil at this current [A], of this sample and the one before.
template <class T>
struct CoilDrive {
  T current_A;
  T voltage_V;
  T voltage_before_V;
  T time_step_s;
};

/// The share of its fastest change by which the voltages of both samples may have driven the current, at most 1; 1
/// where one is missing or none of them counts as a mean. What the calibrated resistance leaves of `largest_V`, driven
/// the other way round, makes the fastest change, through the least inductance.
template <class T>
constexpr T driven_share(const CoilResistance<T>& coil, const CoilDrive<T>& drive, T largest_V, T largest_A) {
  const T held_V = coil.resistance_Ohm * drive.current_A;
  const T left_V = magnitude(drive.voltage_V - held_V) + magnitude(drive.voltage_before_V - held_V);
  const T share = left_V / (largest_V + largest_A * coil.resistance_Ohm);
  return share < T(1) && drive.time_step_s < T(longest_voltage_mean_s) ? share : T(1);  // 1 of a missing voltage
}

/// One sample, `time_step_s` long. A voltage that is NaN leaves it out.
template <class T>
SPOOLFLOW_INLINE constexpr void collect(CoilResistanceState<T>& state, const CoilEquation<T>& sample, T time_step_s) {
  if (is_number(sample.voltage_V)) {
    state.collected_s += time_step_s;
    state.collected.current_A += time_step_s * sample.current_A;
    state.collected.voltage_V += time_step_s * sample.voltage_V;
    state.collected.flux_rate_V += time_step_s * sample.flux_rate_V;
  }
}

/// The mean takes up what was collected; returns how long that lasted [s]. The equation is linear: what holds of each
/// sample holds of their mean, if it is taken of all of them.
template <class T>
constexpr T take_up(CoilResistanceState<T>& state) {
  const T since_s = state.collected_s;
  const T per_time = T(1) / larger(since_s, T(coil_averaging_s));
  const T left = T(1) - since_s * per_time;
  state.mean.current_A = left * state.mean.current_A + per_time * state.collected.current_A;
  state.mean.voltage_V = left * state.mean.voltage_V + per_time * state.collected.voltage_V;
  state.mean.flux_rate_V = left * state.mean.flux_rate_V + per_time * state.collected.flux_rate_V;
  state.collected.current_A = state.collected.voltage_V = state.collected.flux_rate_V = state.collected_s = T(0);
  return since_s;
}

/// The samples that a mean has taken up.
template <class T>
struct CoilEvidence {
  T since_s;  ///< how long they last
  T least_A;  ///< mean current, in size, that says something
};

/// One step of the Kalman filter for all samples since its last one: the resistance drifts for as long as they last,
/// and they are so much evidence and no more, so that it does not matter that the next mean is much alike. Informative
/// where current flows, whether steady or not; a coil whose resistance was never calibrated leaves the estimate alone.
template <class T>
constexpr void follow_resistance(const CoilResistance<T>& coil, CoilResistanceState<T>& state,
                                 const CoilEvidence<T>& evidence) {
  const T since_s = evidence.since_s;
  if (coil.resistance_Ohm > T(0) && since_s > T(0)) {
    const CoilEquation<T>& mean = state.mean;
    const bool begins = is_zero(state.variance_Ohm2);
    if (begins) state.resistance_Ohm = coil.resistance_Ohm;
    if (begins) state.variance_Ohm2 = squared(coil.uncertainty_Ohm);
    state.variance_Ohm2 += squared(coil.drift_Ohm_per_root_s) * since_s;
    if (!(magnitude(mean.current_A) > evidence.least_A)) return;
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
