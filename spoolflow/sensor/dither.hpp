#pragma once
/// Dither: the tremble that the electronics lay on the coil current, 80 to 250 Hz as a rule, so that spool and armature
/// do not stick. Found from the current alone, turning point by turning point, whatever its shape; where a sample
/// averages over most of a period, what is left of its swing counts.
#include <type_traits>

#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// Least swing of the current that is taken for dither, peak to peak, as a share of the largest current.
inline constexpr double least_dither_swing_share = 0.02;
/// The current has turned where it went back by this share of its last swing.
inline constexpr double turning_share = 0.35;
/// No dither has a longer period [s].
inline constexpr double longest_dither_period_s = 0.025;
/// Two half periods are alike where the larger swing, and the longer period less one sample, is no more than so many
/// times the other.
inline constexpr double alike_ratio = 1.6;
/// So many periods alike are dither ...
inline constexpr double periods_of_dither = 3;
/// ... which may last for as many more without them, each half that is not alike counting for so many.
inline constexpr double unlike_weight = 1.5;

/// Memory of the current's turning points; {} before the first sample.
template <class T>
struct DitherState {
  T extreme_A{};  ///< furthest since the last turning point
  T turned_A{};   ///< the last turning point
  T swing_A{};    ///< between the last two, peak to peak
  T since_s{};    ///< since the last period began
  T period_s{};   ///< length of the last period
  T alike{};      ///< periods that were alike, up to twice `periods_of_dither`
  T falling{};    ///< 1 where the current falls since the last turning point, else 0
};

static_assert(std::is_trivially_copyable_v<DitherState<float>>);

template <class T>
struct Dither {
  Mask<T> present;
  Mask<T> begins;  ///< one of its periods, with this sample
};

/// Amplitude of the current's dither [A], half of peak to peak, and its frequency [Hz]; where no dither is present,
/// of whatever the current did last.
template <class T>
constexpr T dither_amplitude_A(const DitherState<T>& state) {
  return T(0.5) * state.swing_A;
}
template <class T>
constexpr T dither_frequency_Hz(const DitherState<T>& state) {
  return select(state.period_s > T(0), T(1) / larger(state.period_s, T(1e-6)), T(0));
}

namespace detail {

/// Whether neither is more than `alike_ratio` times the other; `slack` is added to that.
template <class T>
constexpr Mask<T> alike(T one, T other, T slack) {
  return one < T(alike_ratio) * other + slack && other < T(alike_ratio) * one + slack;
}

/// The current turned: half a period is over.
template <class T>
constexpr void turn(DitherState<T>& state, T swing_A, Mask<T> regular, T current_A) {
  state.alike = select(regular, smaller(state.alike + T(0.5), T(2 * periods_of_dither)),
                       larger(state.alike - T(unlike_weight), T(0)));
  state.swing_A = swing_A;
  state.turned_A = state.extreme_A;
  state.extreme_A = current_A;
  state.falling = T(1) - state.falling;
}

}  // namespace detail

/// One sample of the coil current.
template <class T>
[[gnu::always_inline]] constexpr Dither<T> follow_dither(DitherState<T>& state, T current_A, T largest_current_A,
                                                         T time_step_s) {
  state.since_s += time_step_s;
  const Mask<T> falls = state.falling > T(0.5);
  const T sign = select(falls, T(-1), T(1));
  state.extreme_A = select(sign * current_A > sign * state.extreme_A, current_A, state.extreme_A);
  const T least_A = T(least_dither_swing_share) * largest_current_A;
  const T back_A = sign * (state.extreme_A - current_A);
  const Mask<T> turns = back_A > larger(T(turning_share) * state.swing_A, T(0.5) * least_A);
  const Mask<T> begins = turns && falls;
  in_valves(turns, state, [&] {
    const T swing_A = sign * (state.extreme_A - state.turned_A);
    const Mask<T> regular = swing_A > least_A && detail::alike(swing_A, state.swing_A, T(0)) &&
                            (!begins || detail::alike(state.since_s, state.period_s, time_step_s));
    detail::turn(state, swing_A, regular, current_A);
    state.period_s = select(begins, state.since_s, state.period_s);
    state.since_s = select(begins, T(0), state.since_s);
  });
  in_valves(state.since_s > T(longest_dither_period_s), state, [&] { state.alike = state.swing_A = T(0); });
  return {!(state.alike < T(periods_of_dither)), begins};
}

}  // namespace spoolflow::sensor
