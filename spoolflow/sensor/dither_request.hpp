#pragma once
/// Dither request (active excitation): without dither friction at rest may lie anywhere within its limits, and in
/// motion only the band says how sure its size is. Dither on the coil current bounds friction by its swing, and with it
/// the flow force. So where the valve is open and the band is wider than wanted, this requests dither from the
/// electronics, and none where it is not. Where the band never gets narrow it goes on requesting. Optional: the
/// observer does not need it.
///
/// Dither that does not overcome stiction hides where the spool stands and shows little: the amplitude is raised until
/// it does. Dither is faded in and out, so that the sensor finds it before the spool moves, and the spool comes to rest
/// before it ends.
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

/// Pace [1/s] at which the amplitude is raised where dither does not free the spool, as a share of it, ...
inline constexpr double amplitude_raise_per_s = 5;
/// ... after so long [s], in which dither and band settle.
inline constexpr double dither_settling_s = 0.1;
/// By so much it is lowered after a request that brought the wanted band, as a ratio: too little shows soon, too much
/// does not show at all.
inline constexpr double amplitude_lowering = 0.97;
/// In which dither rises from nothing to its amplitude [s], and falls to nothing again.
inline constexpr double dither_rise_s = 0.1;
inline constexpr double dither_fall_s = 0.2;

/// Limits, set by the firmware engineer; none is ever exceeded. All are >= 0.
template <class T>
struct DitherRequestParameters {
  T wanted_half_width_m3_per_s{};  ///< of the 95 % band of the flow rate: dither is requested where it is wider
  T lowest_amplitude_A{};   ///< of the dither's current, half of peak to peak, with which the first request begins
  T highest_amplitude_A{};  ///< no less than the lowest
  T frequency_Hz{};
  T request_s{};  ///< duration of one request, its rise included; it ends before where the valve closes
  T pause_s{};    ///< the least between the end of one request and the next; 0: dither goes on while the band is wide
};

/// Memory of the requests; {} before the first sample.
template <class T>
struct DitherRequestState {
  T amplitude_A{};  ///< of the request that runs, else of the next one; 0 before the first sample
  T requested_A{};  ///< what was requested last: on its way to that amplitude, or to 0
  T running_s{};    ///< for how long the request has been running
  T pause_s{};      ///< what is left of the pause
  bool runs{};      ///< a request does
};

static_assert(std::is_trivially_copyable_v<DitherRequestParameters<float>>);
static_assert(std::is_trivially_copyable_v<DitherRequestState<float>>);

/// What the electronics are requested to lay on the set current until the next sample.
template <class T>
struct DitherRequest {
  bool active;
  T amplitude_A;   ///< half of peak to peak; 0 where not active
  T frequency_Hz;  ///< 0 where not active
};

namespace detail {

/// The amplitude of the request that runs, `too_small` where it has not freed the spool, or of the next one.
template <class T>
SPOOLFLOW_INLINE constexpr void adapt(const DitherRequestParameters<T>& limits, DitherRequestState<T>& state,
                                      bool too_small, bool was_enough, T step_s) {
  const T raise = too_small ? T(1) + T(amplitude_raise_per_s) * step_s : T(1);
  const T change = was_enough ? T(amplitude_lowering) : raise;
  state.amplitude_A = limited(change * state.amplitude_A, limits.lowest_amplitude_A, limits.highest_amplitude_A);
}

/// Dither on its way to its amplitude, or to nothing.
template <class T>
SPOOLFLOW_INLINE constexpr T fade(const DitherRequestState<T>& state, T step_s) {
  const T step_A = state.amplitude_A * step_s;
  const T aim_A = state.runs ? state.amplitude_A : T(0);
  return limited(aim_A, state.requested_A - T(1 / dither_fall_s) * step_A,
                 state.requested_A + T(1 / dither_rise_s) * step_A);
}

/// Whether dither is needed, by the observer's last answer.
template <class T>
struct DitherNeed {
  bool known;   ///< there is an answer, and it was not held
  bool closed;  ///< the spool covers the metering edge
  bool wide;    ///< the band is wider than wanted
  bool frees;   ///< dither moves the spool both ways in each period
};

/// `position_m`: of the spool, opening > 0; `valve` is what opens there.
template <class T>
SPOOLFLOW_INLINE constexpr DitherNeed<T> dither_need(const DitherRequestParameters<T>& limits,
                                                     const ObserverParameters<T>& valve,
                                                     const ObserverState<T>& observer, T position_m) {
  const Estimate<T>& last = observer.last;
  bool known = observer.started;
  known = known && !has(last.status, Status::sample_missing | Status::time_fault);
  return {known,
          position_m<valve.closed_below_m, last.flow_upper_m3_per_s - last.flow_lower_m3_per_s> T(2) *
              limits.wanted_half_width_m3_per_s,
          observer.swing.frees};
}

template <class T>
constexpr DitherRequest<T> request_dither(const DitherRequestParameters<T>& limits, DitherRequestState<T>& state,
                                          const DitherNeed<T>& need, T time_step_s) {
  const T step_s = time_step_s >= T(0) && is_number(time_step_s) ? time_step_s : T(0);
  state.running_s += step_s;
  state.pause_s = larger(state.pause_s - step_s, T(0));
  const bool lasted = state.runs && state.running_s > limits.request_s - T(0.5) * step_s;  // no matter how it rounds
  const bool ends = lasted || (state.runs && need.closed);
  const bool too_small = state.runs && need.wide && !need.frees && state.running_s > T(dither_settling_s);
  adapt(limits, state, too_small, lasted && !need.closed && !need.wide, step_s);
  if (ends) state.pause_s = limits.pause_s;
  const bool begins = need.known && (!state.runs || ends) && !need.closed && need.wide && !(state.pause_s > T(0)) &&
                      limits.request_s > T(0);
  if (begins) state.running_s = T(0);
  state.runs = begins || (state.runs && !ends);
  state.requested_A = need.closed ? T(0) : smaller(fade(state, step_s), limits.highest_amplitude_A);
  const bool active = state.requested_A > T(0);
  return {active, state.requested_A, active ? limits.frequency_Hz : T(0)};
}

}  // namespace detail

/// After each step of the observer, with its parameters, its state and the same time step. Where the observer holds its
/// answer (`sample_missing`, `time_fault`) no request begins.
template <class T>
constexpr DitherRequest<T> request_dither(const DitherRequestParameters<T>& limits, DitherRequestState<T>& state,
                                          const ObserverParameters<T>& valve, const ObserverState<T>& observer,
                                          T time_step_s) {
  return detail::request_dither(limits, state, detail::dither_need(limits, valve, observer, observer.position.last_m),
                                time_step_s);
}

}  // namespace spoolflow::sensor
