#pragma once
/// The 95 % band: what the errors of the forces and unobserved changes of the supply leave open of the pressure
/// difference, cut off where friction at rest would lie outside its bounds, and what that makes of the flow rate.
#include "spoolflow/sensor/force_balance.hpp"

namespace spoolflow::sensor {

/// Half the width that the flow's own residual takes in the band, over its standard deviation.
inline constexpr double flow_residual_factor = 1.5;

/// Half the width that the swing of friction under dither takes, as a share of half of it: peaks that no sample met.
inline constexpr double swing_deviation_share = 0.02;
/// Drag of spool and armature in motion, which no bench shows [N s/m].
inline constexpr double unmodelled_drag_N_s_per_m = 15;
/// While the spool slips the pressure difference may move with it: the band is so many times wider.
inline constexpr double slip_widening = 2;
/// A supply that moved while the spool rested, told by friction at its bound, may go on unseen: it is taken to have
/// gone on by as much as it was seen to move, but by no more than this share of what friction's other bound leaves.
inline constexpr double unseen_room_share = 0.4;

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

/// The pressure difference to answer with [Pa]: the believed one, and beyond it what may have gone on unseen.
template <class T>
[[gnu::always_inline]] constexpr T expected_pressure_Pa(const PressureState<T>& pressure,
                                                        const ForceBalance<T>& balance, T highest_Pa) {
  const T yielded_Pa = pressure.yielded_Pa;
  if (!any(yielded_Pa != T(0))) return pressure.pressure_difference_Pa;
  const Mask<T> rises = yielded_Pa > T(0);
  const T room_N = select(rises, balance.apparent_friction_N - balance.resting.lower_N,
                          balance.resting.upper_N - balance.apparent_friction_N);
  const T room_Pa = T(unseen_room_share) * pressure_deviation_Pa(balance.edge, larger(room_N, T(0)));
  const T further_Pa = smaller(magnitude(yielded_Pa), room_Pa);
  const T expected_Pa = pressure.pressure_difference_Pa + select(rises, further_Pa, -further_Pa);
  return select(balance.sliding || balance.closed, pressure.pressure_difference_Pa,
                limited(expected_Pa, T(0), highest_Pa));
}

/// What motion leaves open of the forces, to either side [N]: what they ask for beyond what is believed, drag, and the
/// swing of friction under dither.
template <class T>
[[gnu::always_inline]] constexpr T motion_deviation_N(const ForceBalance<T>& balance, T velocity_m_per_s) {
  const T sliding_N = magnitude(balance.apparent_friction_N - balance.friction_N) +
                      T(unmodelled_drag_N_s_per_m) * magnitude(velocity_m_per_s);
  return select(balance.sliding, sliding_N, T(0)) + T(swing_deviation_share) * balance.half_swing_N;
}

/// After the pressure difference was believed. At rest no further than friction's bounds and their uncertainty.
template <class T>
[[gnu::always_inline]] constexpr PressureBand<T> pressure_band(const BandParameters<T>& band,
                                                               const PressureState<T>& pressure,
                                                               const ForceBalance<T>& balance, T rest_s,
                                                               T velocity_m_per_s) {
  const EdgePoint<T>& edge = balance.edge;
  const T share = select(balance.sliding, band.force_share, band.rest_share);
  const T unobserved_Pa = unobserved_change_Pa(pressure, band.unseen_factor);
  const T deviation_Pa =
      band.coverage_factor * pressure.band_factor * select(balance.slips, T(slip_widening), T(1)) *
          sqrt(squared(unobserved_Pa) + squared(pressure_deviation_Pa(edge, share * balance.noise_N))) +
      pressure_deviation_Pa(edge, motion_deviation_N(balance, velocity_m_per_s));
  const T certain_Pa = pressure_deviation_Pa(
      edge, band.coverage_factor * (band.force_share * balance.noise_N + bounds_deviation_N(band, rest_s)));
  PressureBand<T> out{deviation_Pa, deviation_Pa};
  const Mask<T> bounded = !balance.sliding && !balance.slips && !balance.closed;
  if (any(bounded)) {
    const T below_N = larger(balance.resting.upper_N - balance.apparent_friction_N, T(0));
    const T above_N = larger(balance.apparent_friction_N - balance.resting.lower_N, T(0));
    out.below_Pa =
        select(bounded, smaller(deviation_Pa, pressure_deviation_Pa(edge, below_N) + certain_Pa), deviation_Pa);
    out.above_Pa =
        select(bounded, smaller(deviation_Pa, pressure_deviation_Pa(edge, above_N) + certain_Pa), deviation_Pa);
  }
  return out;
}

}  // namespace spoolflow::sensor
