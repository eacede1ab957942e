#pragma once
#include <type_traits>

#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// Coil resistance [Ohm], followed while the valve works: the coil warms, copper by 0.39 % per kelvin. It does not
/// enter the force, which comes from the current (docs/accuracy.md, ablation); it tells of faults of the coil.
template <class T>
struct CoilResistance {
  T resistance_Ohm{};          ///< as calibrated, where following starts; 0: not known
  T uncertainty_Ohm{};         ///< one standard deviation at the start
  T drift_Ohm_per_root_s{};    ///< how fast it may wander
  T voltage_noise_V_root_s{};  ///< of the voltage about R i + d flux/dt, noise density
};

/// Estimate and variance of a scalar Kalman filter; {} before the first sample.
template <class T>
struct CoilResistanceState {
  T resistance_Ohm{};
  T variance_Ohm2{};
  Truth<T> implausible{};  ///< known to better than a tenth, and not what copper can have between -60 and 220 degC
};

static_assert(std::is_trivially_copyable_v<CoilResistanceState<float>>);

/// What the coil's equation u = R i + d flux/dt tells of the resistance during one sample.
template <class T>
struct CoilEquation {
  T time_step_s;
  T current_A;
  T voltage_V;
  T flux_rate_V;
};

/// One step of the Kalman filter. Informative where current flows, whether steady or not; a voltage that is NaN, or
/// a coil whose resistance was never calibrated, leaves the estimate alone.
template <class T>
constexpr void follow_resistance(const CoilResistance<T>& coil, CoilResistanceState<T>& state,
                                 const CoilEquation<T>& sample) {
  in_valves(is_number(sample.voltage_V) && coil.resistance_Ohm > T(0) && sample.time_step_s > T(0), state, [&] {
    const Truth<T> begins = state.variance_Ohm2 == T(0);
    state.resistance_Ohm = select(begins, coil.resistance_Ohm, state.resistance_Ohm);
    state.variance_Ohm2 = select(begins, squared(coil.uncertainty_Ohm), state.variance_Ohm2);
    state.variance_Ohm2 += squared(coil.drift_Ohm_per_root_s) * sample.time_step_s;
    const T misfit_V = sample.voltage_V - sample.flux_rate_V - state.resistance_Ohm * sample.current_A;
    const T covariance = state.variance_Ohm2 * sample.current_A;
    // Where the flux changes fast, most of the voltage drives it, and its model may be a third wrong.
    const T noise2 =
        squared(coil.voltage_noise_V_root_s) + squared(T(1.0 / 3) * sample.flux_rate_V) * sample.time_step_s + T(1e-12);
    const T gain = covariance * sample.time_step_s / (covariance * sample.current_A * sample.time_step_s + noise2);
    state.resistance_Ohm += gain * misfit_V;
    state.variance_Ohm2 -= gain * covariance;
    const T coldest = T(0.6);  // resistance over the calibrated one
    const T warmest = T(1.7);
    state.implausible =
        state.variance_Ohm2 < squared(T(0.1) * coil.resistance_Ohm) &&
        (state.resistance_Ohm < coldest * coil.resistance_Ohm || state.resistance_Ohm > warmest * coil.resistance_Ohm);
  });
}

}  // namespace spoolflow::sensor
