#pragma once
/// Friction under dither: it swings with the magnetic force, many times a second. No single sample tells, but the
/// extremes of a period do: they lie within the limits of friction, and while the spool moves on one of them is at its
/// limit. So friction is told by the middle of its swing, and its limits are nearer by half the swing.
#include <type_traits>

#include "spoolflow/sensor/dither.hpp"

namespace spoolflow::sensor {

/// Half the swing follows that of each period by this share of it at most: samples seldom meet the peaks, and a change
/// of the mean current is no swing.
inline constexpr double swing_following = 0.125;
/// 2 pi / sqrt(4.5): see slip_excess_N.
inline constexpr double slip_excess_factor = 2.962;

/// Extremes of what friction would have to be, in this period of dither and in the one before.
template <class T>
struct FrictionSwingState {
  T highest_N{};
  T lowest_N{};
  T last_highest_N{};
  T last_lowest_N{};
  T half_swing_N{};
  Mask<T> frees{};  ///< dither the spool: both ways in each period
  T periods{};      ///< since dither began or the spool slipped, up to 2
};

static_assert(std::is_trivially_copyable_v<FrictionSwingState<float>>);

/// What friction would have to be, over a period of dither; without dither, at this sample.
template <class T>
struct FrictionSwing {
  T middle_N;
  T half_swing_N;   ///< >= 0
  Mask<T> settled;  ///< a whole period tells
};

/// One sample. `apparent_N` is what friction would have to be, `slips` tells that the spool slips: what the forces do
/// then is not dither's.
template <class T>
[[gnu::always_inline]] constexpr FrictionSwing<T> follow_swing(FrictionSwingState<T>& state, const Dither<T>& dither,
                                                               T apparent_N, Mask<T> slips) {
  const Mask<T> anew = slips || !dither.present;
  if (!any(dither.present)) {
    state.periods = state.half_swing_N = T(0);
    return {apparent_N, T(0), !dither.present};
  }
  const Mask<T> turns = dither.begins && !anew;
  state.periods = select(anew, T(0), select(turns, smaller(state.periods + T(1), T(2)), state.periods));
  const Mask<T> settled = !(state.periods < T(2));
  const Mask<T> lone = anew || (turns && !settled);
  state.last_highest_N = select(lone, apparent_N, select(turns, state.highest_N, state.last_highest_N));
  state.last_lowest_N = select(lone, apparent_N, select(turns, state.lowest_N, state.last_lowest_N));
  state.highest_N = select(anew || turns, apparent_N, larger(state.highest_N, apparent_N));
  state.lowest_N = select(anew || turns, apparent_N, smaller(state.lowest_N, apparent_N));
  const T highest_N = larger(state.highest_N, state.last_highest_N);
  const T lowest_N = smaller(state.lowest_N, state.last_lowest_N);
  const T half_N = T(0.5) * (highest_N - lowest_N);
  const T known_N = state.half_swing_N;
  const T reach_N = select(known_N > T(0), T(swing_following) * known_N, half_N);
  state.half_swing_N = select(turns && settled, limited(half_N, known_N - reach_N, known_N + reach_N),
                              select(dither.present, known_N, T(0)));
  return {select(dither.present, T(0.5) * (highest_N + lowest_N), apparent_N), state.half_swing_N,
          settled || !dither.present};
}

/// The flow force is believed larger by so much: friction would have to be smaller, in what has been as now.
template <class T>
[[gnu::always_inline]] constexpr void shift_swing(FrictionSwingState<T>& state, T flow_force_N) {
  state.highest_N -= flow_force_N;
  state.lowest_N -= flow_force_N;
  state.last_highest_N -= flow_force_N;
  state.last_lowest_N -= flow_force_N;
}

/// By how much the peaks of the force exceed sliding friction where dither moves the spool on in one slip a period: the
/// excess moves a mass. With a force F = E - A (w t)^2/2 about its peak, A half its swing, a slip goes
/// s = 4.5 E^2/(m A w^2), so that
///
///     E = w sqrt(m A s/4.5),   w = 2 pi/period.
///
/// `slip_m` is the way in one period, less what the contacts give elastically. Leaves out drag within the slip.
template <class T>
[[gnu::always_inline]] constexpr T slip_excess_N(T moving_mass_kg, T half_swing_N, T slip_m, T period_s) {
  return T(slip_excess_factor) * sqrt(moving_mass_kg * half_swing_N * larger(slip_m, T(0))) / larger(period_s, T(1e-3));
}

}  // namespace spoolflow::sensor
