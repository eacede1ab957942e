#pragma once
/// Dither: the oscillation that the electronics lay on the coil current, 80 to 250 Hz as a rule, so that spool and
/// armature do not stick. Found from the current alone, turning point by turning point, whatever its shape; where a
/// sample averages over most of a period, what is left of its swing counts.
///
/// Friction under dither: it swings with the magnetic force, many times a second. No single sample measures it, but the
/// extremes of a period do: they lie within the limits of friction, and while the spool moves on one of them is at its
/// limit. So friction is measured by the middle of its swing, and its limits are nearer by half the swing.
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// Least swing of the current that counts as dither, peak to peak, as a share of the largest current.
inline constexpr double least_dither_swing_share = 0.02;
/// The current has turned where it went back by this share of its last swing.
inline constexpr double turning_share = 0.35;
/// No dither has a longer period [s], ...
inline constexpr double longest_dither_period_s = 0.025;
/// ... none that a coil follows a shorter one.
inline constexpr double shortest_dither_period_s = 1e-3;
/// Two half periods are alike where the larger swing, and the longer period less one sample, is no more than so many
/// times the other.
inline constexpr double alike_ratio = 1.6;
/// So many periods alike are dither ...
inline constexpr double periods_of_dither = 3;
/// ... which may last for as many more without them, each half that is not alike counting for so many.
inline constexpr double unlike_weight = 1.5;

/// Memory of the current's turning points; {} before `begin`.
template <class T>
struct DitherState {
  T extreme_A{};          ///< furthest since the last turning point
  T turned_A{};           ///< the last turning point
  T swing_A{};            ///< between the last two, peak to peak
  T since_s{};            ///< since the last period began
  T period_s{};           ///< length of the last period
  T alike{};              ///< periods that were alike, up to twice `periods_of_dither`
  T direction{};          ///< of the current since the last turning point: 1 rises, -1 falls
  T sample_per_period{};  ///< time step over the last period, 0 to 1/2, at its end
};

static_assert(std::is_trivially_copyable_v<DitherState<float>>);

template <class T>
struct Dither {
  bool present;
  bool begins;            ///< one of its periods, with this sample
  bool began;             ///< with the sample before
  T sample_per_period{};  ///< time step over the last period, 0 to 1/2, as it was at its end
};

/// Amplitude of the current's dither [A], half of peak to peak, and its frequency [Hz]; where no dither is present,
/// of whatever the current did last.
template <class T>
constexpr T dither_amplitude_A(const DitherState<T>& state) {
  return T(0.5) * state.swing_A;
}
template <class T>
constexpr T dither_frequency_Hz(const DitherState<T>& state) {
  return state.period_s > T(0) ? T(1) / larger(state.period_s, T(1e-6)) : T(0);
}

namespace detail {

/// Whether neither is more than `alike_ratio` times the other; `margin` is added to that.
template <class T>
constexpr bool alike(T one, T other, T margin) {
  return one < T(alike_ratio) * other + margin && other < T(alike_ratio) * one + margin;
}

/// The current turned: half a period is over.
template <class T>
constexpr void turn(DitherState<T>& state, T swing_A, bool regular, T current_A) {
  state.alike =
      regular ? smaller(state.alike + T(0.5), T(2 * periods_of_dither)) : at_least_zero(state.alike - T(unlike_weight));
  state.swing_A = swing_A;
  state.turned_A = state.extreme_A;
  state.extreme_A = current_A;
  state.direction = -state.direction;
}

}  // namespace detail

/// To be called before the first sample, with its current, and where time has leapt.
template <class T>
constexpr void begin(DitherState<T>& state, T current_A) {
  state.extreme_A = state.turned_A = current_A;
  state.since_s = state.alike = state.sample_per_period = T(0);
  state.direction = T(1);
}

/// One sample of the coil current.
template <class T>
SPOOLFLOW_INLINE constexpr Dither<T> follow_dither(DitherState<T>& state, T current_A, T largest_current_A,
                                                   T time_step_s) {
  const bool began = is_zero(state.since_s);
  if (began) {
    const T period_s = larger(state.period_s, T(shortest_dither_period_s));
    state.sample_per_period = smaller(time_step_s / period_s, T(0.5));
  }
  state.since_s += time_step_s;
  const T back_A = state.direction * (state.extreme_A - current_A);
  if (back_A < T(0)) state.extreme_A = current_A;
  const bool turns =
      back_A > T(0.5 * least_dither_swing_share) * largest_current_A && back_A > T(turning_share) * state.swing_A;
  const bool begins = turns && state.direction < T(0);
  if (turns) {
    const T swing_A = state.direction * (state.extreme_A - state.turned_A);
    const bool regular = swing_A > T(least_dither_swing_share) * largest_current_A &&
                         detail::alike(swing_A, state.swing_A, T(0)) &&
                         (!begins || detail::alike(state.since_s, state.period_s, time_step_s));
    detail::turn(state, swing_A, regular, current_A);
    if (begins) state.period_s = state.since_s;
    if (begins) state.since_s = T(0);
  }
  if (state.since_s > T(longest_dither_period_s)) state.alike = state.swing_A = T(0);
  return {!(state.alike < T(periods_of_dither)), begins, began, state.sample_per_period};
}

/// Half the swing follows that of each period by this share of it at most: samples seldom meet the peaks, and a change
/// of the mean current is no swing.
inline constexpr double swing_following = 0.125;
/// Samples seldom meet the peaks of a swing. With n samples a period at any phase those of one period miss pi2/(6 n2)
/// of it in the mean; the extremes of two periods, whose samples lie between each other's, are taken to miss half of
/// that.
inline constexpr double missed_swing = 0.8;
/// One standard deviation of where the middle lies between peaks of which each may be missed, over half the swing and
/// 1/n2. At most it is pi2/4, where a sample meets the one peak and two pass the other.
inline constexpr double missed_middle = 2;
/// 2 pi / sqrt(4.5): see slip_excess_N.
inline constexpr double slip_excess_factor = 2.962;

/// Extremes of what friction would have to be, in this period of dither and in the one before, at the flow force that
/// was estimated when this one began.
template <class T>
struct FrictionSwingState {
  T flow_force_N{};  ///< estimated more since then
  T highest_N{};
  T lowest_N{};
  T last_highest_N{};
  T last_lowest_N{};
  T half_swing_N{};
  T excess_N{};  ///< of the peaks over sliding friction, while the spool moves
  bool frees{};  ///< dither the spool: both ways in each period
  T periods{};   ///< since dither began, up to 2; -1 without dither
};

static_assert(std::is_trivially_copyable_v<FrictionSwingState<float>>);

/// No swing of friction is known. What `begin_swing` sets stays as it is.
template <class T>
constexpr void forget(FrictionSwingState<T>& state) {
  state.excess_N = state.last_highest_N = T(0);
  state.periods = T(-1);
  state.frees = false;
}

/// What friction would have to be, over a period of dither; without dither, at this sample.
template <class T>
struct FrictionSwing {
  T middle_N;
  T half_swing_N;  ///< >= 0
  bool settled;    ///< a whole period has been measured
};

/// Dither begins. Its first extremes are what friction was without it, with the sample before.
template <class T>
SPOOLFLOW_INLINE constexpr void begin_swing(FrictionSwingState<T>& state) {
  state.periods = state.half_swing_N = state.flow_force_N = T(0);
  state.highest_N = state.lowest_N = state.last_lowest_N = state.last_highest_N;
}

/// A period is over: what was measured in it is kept.
template <class T>
SPOOLFLOW_INLINE constexpr void turn_swing(FrictionSwingState<T>& state, T residual_N) {
  const bool lone = is_zero(state.periods);
  state.periods = smaller(state.periods + T(1), T(2));
  state.last_highest_N = lone ? residual_N : state.highest_N - state.flow_force_N;
  state.last_lowest_N = lone ? residual_N : state.lowest_N - state.flow_force_N;
  state.highest_N = state.lowest_N = residual_N;
  state.flow_force_N = T(0);
}

/// One sample. `residual_N` is what friction would have to be.
template <class T>
SPOOLFLOW_INLINE constexpr FrictionSwing<T> follow_swing(FrictionSwingState<T>& state, const Dither<T>& dither,
                                                         T residual_N) {
  if (!dither.present) {
    state.periods = T(-1);
    state.last_highest_N = residual_N;
    return {residual_N, T(0), true};
  }
  if (state.periods < T(0)) begin_swing(state);
  if (dither.began) turn_swing(state, residual_N);
  const T then_N = residual_N + state.flow_force_N;
  state.highest_N = larger(state.highest_N, then_N);
  state.lowest_N = smaller(state.lowest_N, then_N);
  const bool settled = !(state.periods < T(2));
  const T highest_N = larger(state.highest_N, state.last_highest_N);
  const T lowest_N = smaller(state.lowest_N, state.last_lowest_N);
  if (dither.began && settled) {
    const T half_N = (T(0.5) + T(0.5 * missed_swing) * squared(dither.sample_per_period)) * (highest_N - lowest_N);
    const T known_N = state.half_swing_N;
    const T reach_N = known_N > T(0) ? T(swing_following) * known_N : half_N;
    state.half_swing_N = limited(half_N, known_N - reach_N, known_N + reach_N);
  }
  return {T(0.5) * (highest_N + lowest_N) - state.flow_force_N, state.half_swing_N, settled};
}

/// By how much the peaks of the force exceed sliding friction where dither moves the spool on in one slip a period: the
/// excess moves a mass. With a force F = E - A (w t)^2/2 about its peak, A half its swing, a slip goes
/// s = 4.5 E^2/(m A w^2), so that
///
///     E = w sqrt(m A s/4.5),   w = 2 pi/period.
///
/// `slip_m` is the way in one period, less what the contacts give elastically. Leaves out drag within the slip.
template <class T>
SPOOLFLOW_INLINE constexpr T slip_excess_N(T moving_mass_kg, T half_swing_N, T slip_m, T period_s) {
  return T(slip_excess_factor) * sqrt(moving_mass_kg * half_swing_N * at_least_zero(slip_m)) /
         larger(period_s, T(shortest_dither_period_s));
}

}  // namespace spoolflow::sensor
