#pragma once
/// What the spool does, from a position signal with noise, drift and acquisition faults.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/basis/table.hpp"
#include "spoolflow/sensor/signals/dither.hpp"
#include "spoolflow/sensor/signals/position_state.hpp"

namespace spoolflow::sensor {

namespace detail {

/// The mean of the block that is `back` before the newest.
template <class T>
constexpr T block(const PositionState<T>& state, int back) {
  return state.block_m[static_cast<unsigned>((state.newest & (short_blocks - 1)) + short_blocks - back)];
}
/// The mean over four blocks that ended `back` before the newest.
template <class T>
constexpr T four_blocks(const PositionState<T>& state, int back) {
  return state.four_blocks_m[static_cast<unsigned>((state.newest - back) & (position_blocks - 1))];
}

/// Three windows in a row that travel the same way, evenly and beyond noise: the spool slides. `mean_m(k)` is the mean
/// at the end of the k-th window before now.
template <class T, class Mean>
SPOOLFLOW_INLINE constexpr Motion even_travel(const Mean& mean_m, T threshold_m) {
  const T before = mean_m(1);
  const T newest_m = mean_m(0) - before;
  const T size_m = magnitude(newest_m);
  if (size_m < threshold_m) return Motion::rest;
  const bool opens = newest_m > T(0);
  const T direction = opens ? T(1) : T(-1);
  const T earlier = mean_m(2);
  const T middle_m = direction * (before - earlier);
  if (middle_m < threshold_m) return Motion::rest;
  const T oldest_m = direction * (earlier - mean_m(3));
  if (oldest_m < threshold_m) return Motion::rest;
  const T least_m = smaller(smaller(size_m, middle_m), oldest_m);
  const T longer_m = larger(middle_m, oldest_m);
  const bool uneven = larger(size_m, longer_m) > T(even_travel_ratio) * least_m + threshold_m ||
                      longer_m > T(slowing_travel_ratio) * size_m + threshold_m;
  if (uneven) return Motion::rest;
  return opens ? Motion::opening : Motion::closing;
}

/// Puts the mean of the samples since the last block into the ring.
template <class T>
SPOOLFLOW_INLINE constexpr void close_block(PositionState<T>& state) {
  state.newest = (state.newest + 1) & (position_blocks - 1);
  state.per_block_samples = T(1) / T(state.samples);
  state.lone = !(state.per_block_samples < T(1));
  const T mean_m = state.sum_m * state.per_block_samples;
  const auto newest = static_cast<unsigned>(state.newest);
  state.block_m[newest % short_blocks] = state.block_m[newest % short_blocks + short_blocks] = mean_m;
  state.four_blocks_m[newest] = T(0.25) * (mean_m + block(state, 1) + block(state, 2) + block(state, 3));
  state.block_s = state.sum_s;
  state.velocity_due = true;
  state.blocks = state.blocks < position_blocks ? state.blocks + 1 : position_blocks;
  state.sum_m = state.sum_s = T(0);
  state.samples = 0;
}

/// Opening or closing where the blocks travel evenly, else rest. `noise_m` is that of the difference of two blocks; a
/// spool that creeps by no more than `elastic_m()` in a window rests, and its contacts give way; asked for where the
/// newest window shows more than noise.
template <class T, class Elastic>
SPOOLFLOW_INLINE constexpr Motion even_motion(const PositionState<T>& state, T noise_m, const Elastic& elastic_m) {
  Motion motion = Motion::rest;
  if (state.blocks > 3 * short_window_blocks) {
    motion =
        even_travel([&](int k) { return block(state, k * short_window_blocks); }, T(short_window_deviations) * noise_m);
  }
  if (motion == Motion::rest && state.blocks > 3 * long_window_blocks + 3) {
    const auto mean_m = [&](int k) { return four_blocks(state, k * long_window_blocks); };
    const T least_m = T(long_window_deviations) * noise_m;
    if (!(magnitude(mean_m(0) - mean_m(1)) < least_m)) motion = even_travel(mean_m, larger(least_m, elastic_m()));
  }
  return motion;
}

/// Velocity and acceleration over three short windows.
template <class T>
SPOOLFLOW_INLINE constexpr void follow_velocity(const PositionSensor<T>& sensor, PositionState<T>& state) {
  constexpr int window = short_window_blocks;
  const bool whole = state.blocks > 3 * window;
  state.velocity_due = false;
  if (whole) {
    const T now_m = block(state, 0), oldest_m = block(state, 3 * window);
    const T change_m = now_m - block(state, window) - block(state, 2 * window) + oldest_m;
    const T per_block_s = T(1) / state.block_s;  // a block that has closed has a length
    const T velocity_m_per_s = (now_m - oldest_m) * (per_block_s * T(1.0 / (3 * window)));
    const T acceleration = change_m * (per_block_s * per_block_s * T(1.0 / (2 * window * window)));
    state.acceleration_m_per_s2 = limited_size(acceleration, sensor.hardest_acceleration_m_per_s2);
    state.velocity_m_per_s += (limited_size(velocity_m_per_s, T(fastest_m_per_s)) - state.velocity_m_per_s) *
                              state.block_s / (T(velocity_smoothing_s) + state.block_s);
  }
}

/// The noise that the signal has shown, which a valve's own electronics may have more of than the bench had. Half of
/// its second differences, in size, are larger than their median: it goes up with each that is, and down with every
/// other.
template <class T>
constexpr void follow_noise(const PositionSensor<T>& sensor, PositionNoise<T>& noise, T second_difference_m) {
  constexpr double of_white_noise = 1.6521;  // their median, 0.6745 sqrt(6) standard deviations
  const bool larger_than_half = second_difference_m > noise.median * sensor.noise_m;
  noise.median += larger_than_half ? T(position_noise_follow_share) : T(-position_noise_follow_share);
  noise.times = larger(T(1), noise.median * T(1 / (of_white_noise * position_noise_excess)));
}

/// What the spool does, after each block.
template <class T, class Elastic>
SPOOLFLOW_INLINE constexpr void find_motion(const PositionSensor<T>& sensor, PositionState<T>& state,
                                            const Elastic& elastic_m) {
  // More than none, so that a signal without noise shows no motion where there is none.
  const T noise_m = larger(state.noise.times * sensor.noise_m * sqrt(T(2) * state.per_block_samples), T(1e-12));
  const Motion motion = even_motion(state, noise_m, elastic_m);
  const bool even = motion != Motion::rest;
  if (!even && state.blocks > short_window_blocks) {
    const T signed_travel_m = block(state, 0) - block(state, short_window_blocks);
    const T slow_m = T(slip_speed_m_per_s) * T(short_window_blocks) * state.block_s;
    if (magnitude(signed_travel_m) > slow_m && magnitude(signed_travel_m) > T(slip_deviations) * noise_m) {
      state.unsettled_s = T(slip_settling_s);
      state.travel_m = signed_travel_m;
    }
  }
  if (even) state.travel_m = motion == Motion::opening ? T(direction_only_m) : T(-direction_only_m);
  state.motion = motion;
  if (is_zero(state.unsettled_s)) return;
  state.unsettled_s = even ? T(0) : at_least_zero(state.unsettled_s - state.block_s);
  if (state.unsettled_s > T(0.5) * state.block_s) state.motion = Motion::transient;
}

/// How much more than its noise the signal's step [m] may credibly change: what the largest acceleration allows, more
/// where the current has just changed fast, less where the coil shows no motion.
template <class T>
constexpr T accelerated_m(const PositionSensor<T>& sensor, const PositionState<T>& state, const Sample<T>& sample,
                          const QuietCoil<T>& coil) {
  const T change_share = state.coil.change_A * T(quiet_current_share) / larger(coil.current_A, T(1e-12));
  const T fast_share = at_least_zero(change_share - T(calm_current_rate_per_s) * sample.time_step_s);
  const T hardest_m = sensor.hardest_acceleration_m_per_s2 * sample.time_step_s *
                      (sample.time_step_s + fast_share * T(1 / hard_current_rate_per_s));
  const bool quiet = magnitude(sample.current_A - state.coil.current_A) < coil.current_A &&
                     magnitude(sample.voltage_V - state.coil.voltage_V) < coil.voltage_V &&  // not of a missing voltage
                     magnitude(state.step_m) < T(quiet_jump_m);  // a spool under way passes the current's peak
  return quiet ? smaller(hardest_m, T(quiet_jump_m)) : hardest_m;
}

/// What of a change of the signal [m] the step before it does not explain: a spool may stop in no time, at an end stop
/// or by friction.
template <class T>
SPOOLFLOW_INLINE constexpr T innovation_m(const PositionState<T>& state, T change_m) {
  return change_m - limited(change_m, smaller(state.step_m, T(0)), larger(state.step_m, T(0)));
}

/// A change of the signal's step beyond its noise: what is not credible goes into the offset, or is the way back from a
/// jump that was accepted.
template <class T>
constexpr void judge_jump(PositionState<T>& state, T change_m, T credible_m, T time_step_s) {
  const T innovation_m = detail::innovation_m(state, change_m);
  if (!(magnitude(innovation_m) > credible_m)) return;
  const bool accepted = is_zero(state.offset_m);
  const bool returns = accepted && state.fault_s > T(0) && magnitude(innovation_m - state.elsewhere_m) < credible_m;
  const T offset_m = state.offset_m + innovation_m;
  const T left_m = magnitude(offset_m) < credible_m || returns ? T(0) : offset_m;
  state.offset_m = state.elsewhere_m = left_m;
  if (is_zero(left_m)) {
    state.fault_s = T(0);
  } else if (accepted) {
    state.fault_s = time_step_s;
  }
}

/// One more sample of a fault: a jump that lasts is accepted, then marked, then forgotten. Returns the position.
template <class T>
constexpr T outlast_fault(PositionState<T>& state, T position_m, T time_step_s) {
  if (!is_zero(state.offset_m) && state.fault_s > T(longest_position_fault_s) + T(0.5) * time_step_s) {
    state.elsewhere_m = -state.offset_m;
    state.offset_m = T(0);
    state.last_m = position_m;  // the spool did not move: the next step starts from here
  }
  state.fault_s = state.fault_s > T(longest_position_doubt_s) ? T(0) : state.fault_s + time_step_s;
  return position_m - state.offset_m;
}

/// How much the signal's noise alone may credibly change its step [m].
template <class T>
SPOOLFLOW_INLINE constexpr T credible_noise_m(const PositionSensor<T>& sensor, const PositionState<T>& state) {
  return T(credible_jump_deviations) * sensor.noise_m * state.noise.times + T(credible_jump_m);
}

/// A change beyond what is credible is taken out of the signal until it jumps back, or `longest_position_fault_s` long.
template <class T>
SPOOLFLOW_INLINE constexpr T without_faults(const PositionSensor<T>& sensor, PositionState<T>& state,
                                            const Sample<T>& sample, const QuietCoil<T>& coil, T position_m) {
  const T noise_m = credible_noise_m(sensor, state);
  const T change_m = position_m - state.offset_m - state.last_m;
  const T forgotten_A = coil.current_A * T(current_change_forgotten_per_s / quiet_current_share) * sample.time_step_s;
  state.coil.change_A = larger(magnitude(sample.current_A - state.coil.current_A), state.coil.change_A - forgotten_A);
  if (magnitude(change_m - state.step_m) > noise_m)
    judge_jump(state, change_m, noise_m + accelerated_m(sensor, state, sample, coil), sample.time_step_s);
  const T accepted_m =
      is_zero(state.fault_s) ? position_m - state.offset_m : outlast_fault(state, position_m, sample.time_step_s);
  state.coil.current_A = sample.current_A;
  state.coil.voltage_V = sample.voltage_V;
  state.step_m = accepted_m - state.last_m;
  state.last_m = accepted_m;
  return accepted_m;
}

}  // namespace detail

/// To be called before the first sample, with its drift-free position, and where time has leapt.
template <class T>
constexpr void begin(PositionState<T>& state, T position_m) {
  state.noise = {T(0), T(1)};
  state.last_m = position_m;
  state.sum_m = state.sum_s = state.step_m = state.offset_m = state.unsettled_s = state.velocity_m_per_s = T(0);
  state.acceleration_m_per_s2 = T(0);
  state.coil.change_A = T(0);
  state.fault_s = T(0);
  state.velocity_due = true;  // of no blocks: what follows a block follows the beginning, too
  state.lone = true;
  state.samples = state.blocks = 0;
  state.motion = Motion::rest;
}

/// A sample whose forces are missing, at its drift-free position: the step to the next one is judged from there. A
/// change that the largest acceleration of a calm coil does not explain is left out.
template <class T>
constexpr void follow_unobserved(const PositionSensor<T>& sensor, PositionState<T>& state, T position_m,
                                 T time_step_s) {
  const T change_m = position_m - state.offset_m - state.last_m;
  const T credible_m =
      detail::credible_noise_m(sensor, state) + sensor.hardest_acceleration_m_per_s2 * squared(time_step_s);
  if (magnitude(detail::innovation_m(state, change_m)) > credible_m) return;
  state.step_m = change_m;
  state.last_m += change_m;
}

/// One sample. `drift_m`: see drift_m(). `elastic_m()` >= 0 is how far the contacts give way under the friction that
/// they hold, which is asked where the spool may creep.
template <class T, class Elastic>
SPOOLFLOW_INLINE constexpr PositionPoint<T> track(const PositionSensor<T>& sensor, PositionState<T>& state,
                                                  const Sample<T>& sample, const QuietCoil<T>& coil, T drift_m,
                                                  const Dither<T>& dither, bool freed, const Elastic& elastic_m) {
  const T time_step_s = sample.time_step_s;
  const bool follows_block = state.velocity_due;
  if (follows_block) detail::follow_velocity(sensor, state);
  const T step_before_m = state.step_m;
  const T position_m = detail::without_faults(sensor, state, sample, coil, sample.position_m - drift_m);
  state.sum_m += position_m;
  state.sum_s += time_step_s;
  state.samples = state.samples + 1;
  const bool whole = state.sum_s > T(block_length_s) - T(0.5) * time_step_s;  // no matter how the sum rounds
  const bool dithers = dither.present && freed && state.sum_s < T(longest_dither_block_s);
  const bool closed = whole && (dither.begins || !dithers);
  if (closed) {
    detail::follow_noise(sensor, state.noise, magnitude(state.step_m - step_before_m));
    detail::close_block(state);
    detail::find_motion(sensor, state, elastic_m);
  }
  const bool even = ((state.newest + state.samples) & 1) == 0;
  return {position_m,
          state.motion,
          state.travel_m,
          state.velocity_m_per_s,
          state.acceleration_m_per_s2,
          state.noise.times,
          {closed, follows_block, state.lone, even, state.block_s}};
}

}  // namespace spoolflow::sensor
