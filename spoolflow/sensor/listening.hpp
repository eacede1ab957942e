#pragma once
/// Listening: at rest without dither friction may lie anywhere within its limits, and the band is wide. Dither on the
/// coil current bounds friction by its swing, and with it the flow force. So where the spool rests open and the band is
/// wider than wanted, this asks the electronics for dither, and for none where it is not. Optional: the observer
/// neither needs nor knows it.
///
/// Dither is faded in and out, so that the sensor knows it for dither before the spool trembles, and the spool comes to
/// rest before it ends.
#include <type_traits>

#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

/// By so much the amplitude is raised after a request that did not bring the wanted band, as a ratio.
inline constexpr double amplitude_raise = 1.3;
/// By so much it is lowered after one that did, as a ratio: too little shows soon, too much does not show at all.
inline constexpr double amplitude_lowering = 0.97;
/// The spool must have rested so long [s] before dither is asked for: shorter rests are part of a motion.
inline constexpr double rest_before_listening_s = 0.05;
/// Motion that lasts no longer than this [s] is the tremble, or dither freeing the spool: it ends no request.
inline constexpr double longest_tremble_s = 0.06;
/// In which dither rises from nothing to its amplitude [s], and falls to nothing again.
inline constexpr double dither_rise_s = 0.1;
inline constexpr double dither_fall_s = 0.2;

/// Limits, set by the firmware engineer; none is ever exceeded. All are >= 0.
template <class T>
struct ListeningParameters {
  T wanted_half_width_m3_per_s{};  ///< of the 95 % band of the flow rate: dither is asked for where it is wider
  T lowest_amplitude_A{};          ///< of the dither's current, half of peak to peak, with which listening begins
  T highest_amplitude_A{};         ///< no less than the lowest
  T frequency_Hz{};
  T request_s{};  ///< duration of one request, its rise included; it ends before where the spool slides or closes
  T pause_s{};    ///< the least between the end of one request and the next; 0: dither goes on while the band is wide
};

/// Memory of listening; {} before the first sample.
template <class T>
struct ListeningState {
  T amplitude_A{};  ///< of the request that runs, else of the next one; 0 before the first sample
  T given_A{};      ///< what was answered last: on its way to that amplitude, or to 0
  T asked_s{};      ///< for how long the request that runs has been asking
  T pause_s{};      ///< what is left of the pause
  T rested_s{};     ///< since the spool last moved
  T moved_s{};      ///< for how long it has been moving
  Mask<T> asks{};   ///< a request runs
};

static_assert(std::is_trivially_copyable_v<ListeningParameters<float>>);
static_assert(std::is_trivially_copyable_v<ListeningState<float>>);

/// What the electronics are asked to lay on the set current until the next sample.
template <class T>
struct DitherRequest {
  Mask<T> active;
  T amplitude_A;   ///< half of peak to peak; 0 where not active
  T frequency_Hz;  ///< 0 where not active
};

namespace detail {

/// What the spool does, as listening sees it.
template <class T>
struct ListeningMoment {
  Mask<T> closed;
  Mask<T> slides;  ///< for longer than a tremble
  Mask<T> rests;   ///< for so long that dither may be asked for
};

template <class T>
[[gnu::always_inline]] constexpr ListeningMoment<T> follow_rest(ListeningState<T>& state, T closed_below_m,
                                                                const PositionState<T>& position, T step_s) {
  const Mask<T> moves = is(position.motion, Motion::opening) || is(position.motion, Motion::closing);
  state.moved_s = select(moves, state.moved_s + step_s, T(0));
  state.rested_s = select(moves, T(0), state.rested_s + step_s);
  return {position.last_m<closed_below_m, state.moved_s> T(longest_tremble_s),
          is(position.motion, Motion::rest) && state.rested_s > T(rest_before_listening_s)};
}

/// The running request ends: its amplitude was enough, or it was not, or it could not tell.
template <class T>
[[gnu::always_inline]] constexpr void end_request(const ListeningParameters<T>& limits, ListeningState<T>& state,
                                                  Mask<T> ends, Mask<T> tells, Mask<T> wide) {
  const T change = select(ends && tells, select(wide, T(amplitude_raise), T(amplitude_lowering)), T(1));
  state.amplitude_A = limited(change * state.amplitude_A, limits.lowest_amplitude_A, limits.highest_amplitude_A);
  state.pause_s = select(ends, limits.pause_s, state.pause_s);
}

/// Dither on its way to its amplitude, or to nothing.
template <class T>
[[gnu::always_inline]] constexpr T fade(const ListeningState<T>& state, T step_s) {
  const T step_A = state.amplitude_A * step_s;
  const T aim_A = select(state.asks, state.amplitude_A, T(0));
  return limited(aim_A, state.given_A - T(1 / dither_fall_s) * step_A, state.given_A + T(1 / dither_rise_s) * step_A);
}

}  // namespace detail

/// After each step of the observer, with its parameters, its state and the same time step. Where the observer holds its
/// answer (`sample_missing`, `time_fault`) no request begins.
template <class T>
constexpr DitherRequest<T> listen(const ListeningParameters<T>& limits, ListeningState<T>& state,
                                  const ObserverParameters<T>& valve, const ObserverState<T>& observer, T time_step_s) {
  Mask<T> known = observer.started;
  if constexpr (one_valve<T>) {
    known = known && !has(observer.last.status, Status::sample_missing | Status::time_fault);
  }
  const T step_s = select(time_step_s >= T(0) && is_number(time_step_s), time_step_s, T(0));
  const detail::ListeningMoment<T> spool = detail::follow_rest(state, valve.closed_below_m, observer.position, step_s);
  const Mask<T> wide =
      observer.last.flow_upper_m3_per_s - observer.last.flow_lower_m3_per_s > T(2) * limits.wanted_half_width_m3_per_s;

  state.asked_s += step_s;
  state.pause_s = larger(state.pause_s - step_s, T(0));
  const Mask<T> lasted = state.asked_s > limits.request_s - T(0.5) * step_s;  // no matter how the sum rounds
  const Mask<T> ends = state.asks && (lasted || spool.slides || spool.closed);
  detail::end_request(limits, state, ends, lasted && !spool.slides && !spool.closed, wide);
  const Mask<T> begins = known && (!state.asks || ends) && spool.rests && !spool.closed && wide &&
                         !(state.pause_s > T(0)) && limits.request_s > T(0);
  state.asked_s = select(begins, T(0), state.asked_s);
  state.asks = begins || (state.asks && !ends);
  state.given_A = select(spool.closed, T(0), smaller(detail::fade(state, step_s), limits.highest_amplitude_A));
  const Mask<T> active = state.given_A > T(0);
  return {active, state.given_A, select(active, limits.frequency_Hz, T(0))};
}

}  // namespace spoolflow::sensor
