#pragma once
/// The 95 % band: what the errors of the forces and unobserved changes of the supply leave open of the pressure
/// difference, cut off where friction at rest would lie outside its bounds, and what that makes of the flow rate.
#include "spoolflow/sensor/force_balance.hpp"

namespace spoolflow::sensor {

/// Half the width that the flow's own residual takes in the band, over its standard deviation.
inline constexpr double flow_residual_factor = 1.2;

/// How much wider than its parts tell the band must be, as the forces have been agreeing: wider under dither or on a
/// supply that leaps, narrower where every sample confirms the one before. The root of the normalised innovation's
/// size.
template <class T>
constexpr T band_factor(const PressureState<T>& state) {
  return limited(sqrt(sqrt(state.innovation_squared * (T(1) / T(usual_innovation_squared)))), T(least_band_factor),
                 T(most_band_factor));
}

/// One standard deviation of where the bounds of friction at rest lie [N]: it grows while the spool rests.
template <class T>
constexpr T bounds_deviation_N(const BandParameters<T>& band, T rest_s) {
  return band.tolerance_N * (T(1) + band.creep_per_s * rest_s);
}

/// One standard deviation of the pressure difference that a force error makes [Pa].
template <class T>
[[gnu::always_inline]] constexpr T pressure_deviation_Pa(const EdgePoint<T>& edge, T force_N) {
  return force_N / edge.flow_force_per_pressure_N_Pa;
}

/// What is left open of the pressure difference, to either side [Pa, >= 0].
template <class T>
struct PressureBand {
  T below_Pa;
  T above_Pa;
};

/// After the pressure difference was believed. At rest no further than friction's bounds and their uncertainty.
template <class T>
[[gnu::always_inline]] constexpr PressureBand<T> pressure_band(const BandParameters<T>& band,
                                                               const PressureState<T>& pressure,
                                                               const ForceBalance<T>& balance, T rest_s) {
  const T slope = balance.edge.flow_force_per_pressure_N_Pa;
  const T share = select(balance.sliding, band.force_share, band.rest_share);
  const T unobserved_Pa = unobserved_change_Pa(pressure, band.unseen_factor);
  const T deviation_Pa = band.coverage_factor * band_factor(pressure) *
                         sqrt(squared(unobserved_Pa) + squared(share * balance.noise_N / slope));
  const T certain_Pa =
      band.coverage_factor * (band.force_share * balance.noise_N + bounds_deviation_N(band, rest_s)) / slope;
  PressureBand<T> out{deviation_Pa, deviation_Pa};
  const Mask<T> bounded = !balance.sliding && !balance.closed;
  if (any(bounded)) {
    const T below_N = larger(balance.resting.upper_N - balance.apparent_friction_N, T(0));
    const T above_N = larger(balance.apparent_friction_N - balance.resting.lower_N, T(0));
    out.below_Pa = select(bounded, smaller(deviation_Pa, below_N / slope + certain_Pa), deviation_Pa);
    out.above_Pa = select(bounded, smaller(deviation_Pa, above_N / slope + certain_Pa), deviation_Pa);
  }
  return out;
}

}  // namespace spoolflow::sensor
