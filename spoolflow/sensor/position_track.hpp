#pragma once
/// What the spool does, from a position signal with noise, drift and acquisition faults.
#include "spoolflow/sensor/dither.hpp"
#include "spoolflow/sensor/position_state.hpp"
#include "spoolflow/sensor/sample.hpp"
#include "spoolflow/sensor/table.hpp"

namespace spoolflow::sensor {

namespace detail {

/// The mean of the block that is `back` before the newest.
template <class T>
constexpr T block(const PositionState<T>& state, int back) {
  return in_ring(state.block_m, (state.newest & (short_blocks - 1)) + (short_blocks - back));
}
/// The mean over four blocks that ended `back` before the newest.
template <class T>
constexpr T four_blocks(const PositionState<T>& state, int back) {
  return in_ring(state.four_blocks_m, (state.newest - back) & (position_blocks - 1));
}

/// Three windows in a row that travel the same way, evenly and beyond noise: the spool slides. `mean_m(k)` is the mean
/// at the end of the k-th window before now.
template <class T, class Mean>
[[gnu::always_inline]] constexpr MotionOf<T> even_travel(const Mean& mean_m, T threshold_m) {
  const T before = mean_m(1);
  const T newest_m = mean_m(0) - before;
  const T size_m = magnitude(newest_m);
  const MotionOf<T> rest = MotionOf<T>(Motion::rest);
  const T least_travel_m = larger(threshold_m, T(1e-12));  // more than none, without noise, too
  Mask<T> even = !(size_m < least_travel_m);
  if (!any(even)) return rest;
  const Mask<T> opens = newest_m > T(0);
  const T direction = select(opens, T(1), T(-1));
  const T earlier = mean_m(2);
  const T middle_m = direction * (before - earlier);
  even = even && !(middle_m < least_travel_m);
  if (!any(even)) return rest;
  const T oldest_m = direction * (earlier - mean_m(3));
  even = even && !(oldest_m < least_travel_m);
  if (!any(even)) return rest;
  const T least_m = smaller(smaller(size_m, middle_m), oldest_m);
  const T longer_m = larger(middle_m, oldest_m);
  even = even && !(larger(size_m, longer_m) > T(even_travel_ratio) * least_m + threshold_m);
  even = even && !(longer_m > T(slowing_travel_ratio) * size_m + threshold_m);
  return select(even, select(opens, MotionOf<T>(Motion::opening), MotionOf<T>(Motion::closing)), rest);
}

/// Puts the mean of the samples since the last block into the ring.
template <class T>
[[gnu::always_inline]] constexpr void close_block(PositionState<T>& state) {
  state.newest = (state.newest + 1) & (position_blocks - 1);
  state.per_block_samples = T(1) / T(state.samples);
  state.lone = !(state.per_block_samples < T(1));
  const T mean_m = state.sum_m * state.per_block_samples;
  put_in_ring(state.block_m, state.newest & (short_blocks - 1), mean_m);
  put_in_ring(state.block_m, (state.newest & (short_blocks - 1)) + short_blocks, mean_m);
  put_in_ring(state.four_blocks_m, state.newest,
              T(0.25) * (mean_m + block(state, 1) + block(state, 2) + block(state, 3)));
  state.block_s = state.sum_s;
  state.velocity_due = Mask<T>(true);
  state.blocks = select(state.blocks < position_blocks, state.blocks + 1, Index<T>(position_blocks));
  state.sum_m = state.sum_s = T(0);
  state.samples = Index<T>(0);
}

/// Opening or closing where the blocks travel evenly, else rest. `noise_m` is that of the difference of two blocks.
template <class T>
[[gnu::always_inline]] constexpr MotionOf<T> even_motion(const PositionState<T>& state, T noise_m) {
  using Motions = MotionOf<T>;
  Motions motion = Motions(Motion::rest);
  const Mask<T> near = state.blocks > 3 * short_window_blocks;
  if (any(near)) {
    motion = select(
        near,
        even_travel([&](int k) { return block(state, k * short_window_blocks); }, T(short_window_deviations) * noise_m),
        motion);
  }
  const Mask<T> far = is(motion, Motion::rest) && state.blocks > 3 * long_window_blocks + 3;
  if (any(far)) {
    motion = select(far,
                    even_travel([&](int k) { return four_blocks(state, k * long_window_blocks); },
                                T(long_window_deviations) * noise_m),
                    motion);
  }
  return motion;
}

/// Velocity and acceleration over three short windows.
template <class T>
[[gnu::always_inline]] constexpr void follow_velocity(const PositionSensor<T>& sensor, PositionState<T>& state) {
  constexpr int window = short_window_blocks;
  const Mask<T> whole = state.blocks > 3 * window;
  state.velocity_due = Mask<T>(false);
  in_valves(whole, state, [&] {
    const T now_m = block(state, 0), oldest_m = block(state, 3 * window);
    const T change_m = now_m - block(state, window) - block(state, 2 * window) + oldest_m;
    const T per_block_s = T(1) / larger(state.block_s, T(shortest_block_s));
    const T velocity_m_per_s = (now_m - oldest_m) * (per_block_s * T(1.0 / (3 * window)));
    const T acceleration = change_m * (per_block_s * per_block_s * T(1.0 / (2 * window * window)));
    const T hardest = sensor.hardest_acceleration_m_per_s2, fastest = T(fastest_m_per_s);
    state.acceleration_m_per_s2 = limited(acceleration, -hardest, hardest);
    state.velocity_m_per_s += (limited(velocity_m_per_s, -fastest, fastest) - state.velocity_m_per_s) * state.block_s /
                              (T(velocity_smoothing_s) + state.block_s);
  });
}

/// The noise that the signal has shown, which a valve's own electronics may have more of than the bench had. Half of
/// its second differences, in size, are larger than their median: it goes up with each that is, and down with every
/// other.
template <class T>
constexpr void follow_noise(const PositionSensor<T>& sensor, PositionNoise<T>& noise, T second_difference_m) {
  constexpr double of_white_noise = 1.6521;  // their median, 0.6745 sqrt(6) standard deviations
  const Mask<T> larger_than_half = second_difference_m > noise.median * sensor.noise_m;
  noise.median += select(larger_than_half, T(position_noise_follow_share), T(-position_noise_follow_share));
  noise.times = larger(T(1), noise.median * T(1 / (of_white_noise * position_noise_excess)));
}

/// What the spool does, after each block.
template <class T>
[[gnu::always_inline]] constexpr void tell_motion(const PositionSensor<T>& sensor, PositionState<T>& state) {
  const T noise_m = state.noise.times * sensor.noise_m * sqrt(T(2) * state.per_block_samples);
  const MotionOf<T> motion = even_motion(state, noise_m);
  const Mask<T> even = !is(motion, Motion::rest);
  const Mask<T> uneven = !even && state.blocks > short_window_blocks;
  if (any(uneven)) {
    const T signed_travel_m = block(state, 0) - block(state, short_window_blocks);
    const T slow_m = T(slip_speed_m_per_s) * T(short_window_blocks) * state.block_s;
    const Mask<T> slips = uneven && magnitude(signed_travel_m) > larger(slow_m, T(slip_deviations) * noise_m);
    state.unsettled_s = select(slips, T(slip_settling_s), state.unsettled_s);
    state.travel_m = select(slips, signed_travel_m, state.travel_m);
  }
  const T direction_m = select(is(motion, Motion::opening), T(direction_only_m), T(-direction_only_m));
  state.travel_m = select(even, direction_m, state.travel_m);
  state.unsettled_s = select(even, T(0), larger(state.unsettled_s - state.block_s, T(0)));
  const Mask<T> unsettled = state.unsettled_s > T(0.5) * state.block_s;
  using Motions = MotionOf<T>;
  state.motion = select(even, motion, select(unsettled, Motions(Motion::transient), Motions(Motion::rest)));
}

/// How much more than its noise the signal's step [m] may credibly change: what the hardest acceleration allows, or
/// less where the coil tells of no motion.
template <class T>
constexpr T accelerated_m(const PositionSensor<T>& sensor, const PositionState<T>& state, const Sample<T>& sample,
                          const QuietCoil<T>& coil) {
  const T hardest_m = sensor.hardest_acceleration_m_per_s2 * sample.time_step_s * sample.time_step_s;
  const Mask<T> quiet = magnitude(sample.current_A - state.current_A) < coil.current_A &&
                        magnitude(sample.voltage_V - state.voltage_V) < coil.voltage_V &&  // not of a missing voltage
                        magnitude(state.step_m) < T(quiet_jump_m);  // a spool under way passes the current's peak
  return select(quiet, smaller(hardest_m, T(quiet_jump_m)), hardest_m);
}

/// A change of the signal's step beyond its noise: what is not credible goes into the offset, or is the way back from a
/// jump that was believed.
template <class T>
constexpr void judge_jump(PositionState<T>& state, Mask<T> unusual, T change_m, T credible_m, T time_step_s) {
  // A spool may stop in no time, at an end stop or by friction.
  const T innovation_m = change_m - limited(change_m, smaller(state.step_m, T(0)), larger(state.step_m, T(0)));
  const Mask<T> jumps = unusual && magnitude(innovation_m) > credible_m;
  const Mask<T> believed = is_zero(state.offset_m);
  const Mask<T> returns =
      jumps && believed && state.fault_s > T(0) && magnitude(innovation_m - state.elsewhere_m) < credible_m;
  const T offset_m = state.offset_m + innovation_m;
  const T left_m = select(magnitude(offset_m) < credible_m || returns, T(0), offset_m);
  state.offset_m = select(jumps, left_m, state.offset_m);
  state.elsewhere_m = select(jumps, left_m, state.elsewhere_m);
  state.fault_s =
      select(jumps, select(is_zero(left_m), T(0), select(believed, time_step_s, state.fault_s)), state.fault_s);
}

/// One more sample of a fault: a jump that lasts is believed, then doubted, then forgotten. Returns the position.
template <class T>
constexpr T outlast_fault(PositionState<T>& state, Mask<T> faulty, T position_m, T time_step_s) {
  const Mask<T> believes =
      faulty && !is_zero(state.offset_m) && state.fault_s > T(longest_position_fault_s) + T(0.5) * time_step_s;
  state.elsewhere_m = select(believes, -state.offset_m, state.elsewhere_m);
  state.offset_m = select(believes, T(0), state.offset_m);
  const T believed_m = position_m - state.offset_m;
  // The spool did not move: the next step starts from here.
  state.last_m = select(believes, position_m, state.last_m);
  const T goes_on_s = select(state.fault_s > T(longest_position_doubt_s), T(0), state.fault_s + time_step_s);
  state.fault_s = select(faulty, goes_on_s, state.fault_s);
  return believed_m;
}

/// A change beyond what is credible is taken out of the signal until it jumps back, or `longest_position_fault_s` long.
template <class T>
[[gnu::always_inline]] constexpr T without_faults(const PositionSensor<T>& sensor, PositionState<T>& state,
                                                  const Sample<T>& sample, const QuietCoil<T>& coil, T position_m) {
  const T noise_m = T(credible_jump_deviations) * sensor.noise_m * state.noise.times + T(credible_jump_m);
  const T change_m = position_m - state.offset_m - state.last_m;
  const Mask<T> unusual = magnitude(change_m - state.step_m) > noise_m;
  if (any(unusual)) {
    judge_jump(state, unusual, change_m, noise_m + accelerated_m(sensor, state, sample, coil), sample.time_step_s);
  }
  T believed_m = position_m - state.offset_m;
  if (const Mask<T> faulty = !is_zero(state.fault_s); any(faulty))
    believed_m = outlast_fault(state, faulty, position_m, sample.time_step_s);
  state.current_A = sample.current_A;
  state.voltage_V = sample.voltage_V;
  state.step_m = believed_m - state.last_m;
  state.last_m = believed_m;
  return believed_m;
}

}  // namespace detail

/// To be called before the first sample, with its drift-free position, and where time has leapt.
template <class T>
constexpr void begin(PositionState<T>& state, T position_m) {
  state.noise = {T(0), T(1)};
  state.last_m = position_m;
  state.sum_m = state.sum_s = state.step_m = state.offset_m = state.unsettled_s = state.velocity_m_per_s = T(0);
  state.acceleration_m_per_s2 = T(0);
  state.fault_s = T(0);
  state.velocity_due = Mask<T>(false);
  state.lone = Mask<T>(true);
  state.samples = state.blocks = Index<T>(0);
  state.motion = MotionOf<T>(Motion::rest);
}

/// From one slow turn to the next [s].
template <class T>
constexpr T slow_period_s(const PositionState<T>& state) {
  return state.block_s * select(state.lone, T(1), T(2));
}

namespace detail {

template <class T>
constexpr Turn<T> turn_of(const PositionState<T>& state, Mask<T> closed, Mask<T> follows_a_block) {
  const Mask<T> busy = closed && !state.lone;
  const Mask<T> parity = ((state.newest + state.samples) & 1) == 0;
  const Mask<T> odd = state.lone || (!busy && !parity);
  const Mask<T> even = state.lone || (!busy && parity);
  return {closed, busy, even, odd, even && follows_a_block, odd && follows_a_block};
}

}  // namespace detail

/// One sample.
template <class T>
[[gnu::always_inline]] constexpr PositionPoint<T> track(const PositionSensor<T>& sensor, PositionState<T>& state,
                                                        const Sample<T>& sample, const QuietCoil<T>& coil,
                                                        T oil_temperature_K, const Dither<T>& dither, Mask<T> freed) {
  const T time_step_s = sample.time_step_s;
  const Mask<T> due = state.velocity_due;
  in_valves(due, state, [&] { detail::follow_velocity(sensor, state); });
  const T step_before_m = state.step_m;
  const T position_m =
      detail::without_faults(sensor, state, sample, coil, drift_free_m(sensor, sample.position_m, oil_temperature_K));
  state.sum_m += position_m;
  state.sum_s += time_step_s;
  state.samples = state.samples + 1;
  const Mask<T> whole = state.sum_s > T(block_length_s) - T(0.5) * time_step_s;  // no matter how the sum rounds
  const Mask<T> trembles = freed && dither.present && state.sum_s < T(longest_tremble_block_s);
  const Mask<T> closed = whole && (dither.begins || !trembles);
  in_valves(
      closed, state, [&]() __attribute__((always_inline)) {
        detail::follow_noise(sensor, state.noise, magnitude(state.step_m - step_before_m));
        detail::close_block(state);
        detail::tell_motion(sensor, state);
      });
  const Turn<T> turn = detail::turn_of(state, closed, due);
  return {position_m,
          state.motion,
          !is_zero(state.fault_s),
          state.travel_m,
          state.velocity_m_per_s,
          state.acceleration_m_per_s2,
          position_m + state.elsewhere_m,
          state.block_s,
          state.noise.times,
          turn};
}

}  // namespace spoolflow::sensor
