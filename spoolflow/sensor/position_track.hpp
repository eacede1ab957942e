#pragma once
/// What the spool does, from a position signal with noise, drift and acquisition faults.
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

/// The valve's position sensor.
template <class T>
struct PositionSensor {
  T noise_m{};                        ///< standard deviation of one sample
  T backlash_m{};                     ///< half width: how far the spool may creep unseen
  T drift_m_per_K{};                  ///< of the zero point over the oil temperature
  T drift_free_K{};                   ///< oil temperature at which the zero point is right
  T hardest_acceleration_m_per_s2{};  ///< no spool moves harder: a jump beyond it is a fault of the signal
};

enum class Motion : std::uint8_t {
  rest,       ///< nothing moves by more than noise
  transient,  ///< a slip, or the end of one: friction and inertia are in motion
  opening,    ///< slides evenly: friction has its full size and its sign is known
  closing,
};

constexpr bool is(Motion motion, Motion which) {
  return motion == which;
}
constexpr Motion select(bool condition, Motion yes, Motion no) {
  return condition ? yes : no;
}
constexpr int select(bool condition, int yes, int no) {
  return condition ? yes : no;
}

/// What a spool does; of several, what each of them does.
template <class T>
using MotionOf = std::conditional_t<one_valve<T>, Motion, Index<T>>;

inline constexpr int position_blocks = 32;

/// One number of a ring; a pack takes each valve's own.
template <class T>
constexpr T in_ring(const std::array<T, position_blocks>& ring, int place) {
  return ring[static_cast<unsigned>(place)];
}
template <class T>
constexpr void put_in_ring(std::array<T, position_blocks>& ring, int place, T value) {
  ring[static_cast<unsigned>(place)] = value;
}

/// Trivially copyable memory of a track. The ring holds means over blocks of some milliseconds, newest at `newest`.
template <class T>
struct PositionState {
  std::array<T, position_blocks> block_m{};
  std::array<T, position_blocks> four_blocks_m{};  ///< means of the block and the three before
  T sum_m{};
  T sum_s{};
  T block_s{};
  T per_block_samples{};  ///< 1 / samples in a block
  T last_m{};
  T step_m{};       ///< last believed change
  T offset_m{};     ///< what an acquisition fault adds to the signal
  T fault_s{};      ///< how long the fault has lasted
  T unsettled_s{};  ///< time until a slip counts as over
  T travel_m{};     ///< over the last blocks of a motion, sign of the velocity
  Index<T> samples{};
  Index<T> newest{};
  Index<T> blocks{};
  MotionOf<T> motion{};  ///< at rest
};

template <class T>
struct PositionPoint {
  T position_m;  ///< free of drift and faults
  MotionOf<T> motion;
  Truth<T> fault;
  T travel_m;  ///< sign of the velocity of what `motion` tells
};

namespace detail {

/// The mean that is `back` blocks before the newest of a ring.
template <class T>
constexpr T block(const PositionState<T>& state, const std::array<T, position_blocks>& ring, int back) {
  return in_ring(ring, (state.newest - back) & (position_blocks - 1));
}

/// Three windows in a row that travel the same way, evenly and beyond noise: the spool slides. Windows are `apart`
/// blocks of the ring.
template <class T>
constexpr MotionOf<T> even_travel(const PositionState<T>& state, const std::array<T, position_blocks>& ring, int apart,
                                  T threshold_m) {
  const T now = block(state, ring, 0);
  const T before = block(state, ring, apart);
  const T newest_m = now - before;
  const T size_m = magnitude(newest_m);
  const MotionOf<T> rest = MotionOf<T>(Motion::rest);
  Truth<T> even = !(size_m < threshold_m);
  if (!any(even)) return rest;
  const T direction = select(newest_m > T(0), T(1), T(-1));
  const T earlier = block(state, ring, 2 * apart);
  const T middle_m = direction * (before - earlier);
  even = even && middle_m > T(0) && !(middle_m < threshold_m);
  if (!any(even)) return rest;
  const T oldest_m = direction * (earlier - block(state, ring, 3 * apart));
  even = even && oldest_m > T(0) && !(oldest_m < threshold_m);
  if (!any(even)) return rest;
  const T least_m = smaller(smaller(size_m, middle_m), oldest_m);
  even = even && !(larger(larger(size_m, middle_m), oldest_m) > T(2) * least_m + threshold_m);
  return select(even, select(newest_m > T(0), MotionOf<T>(Motion::opening), MotionOf<T>(Motion::closing)), rest);
}

template <class T>
[[gnu::always_inline]] constexpr void close_block(const PositionSensor<T>& sensor, PositionState<T>& state) {
  state.newest = (state.newest + 1) & (position_blocks - 1);
  state.per_block_samples = T(1) / T(state.samples);
  put_in_ring(state.block_m, state.newest, state.sum_m * state.per_block_samples);
  put_in_ring(state.four_blocks_m, state.newest,
              T(0.25) * (block(state, state.block_m, 0) + block(state, state.block_m, 1) +
                         block(state, state.block_m, 2) + block(state, state.block_m, 3)));
  state.block_s = state.sum_s;
  state.blocks = select(state.blocks < position_blocks, state.blocks + 1, Index<T>(position_blocks));
  state.sum_m = state.sum_s = T(0);
  state.samples = Index<T>(0);
  const T noise_m = sensor.noise_m * sqrt(T(2) * state.per_block_samples);  // of the difference of two blocks

  using Motions = MotionOf<T>;
  Motions motion = Motions(Motion::rest);
  const Truth<T> near = state.blocks > 6;
  if (any(near)) motion = select(near, even_travel(state, state.block_m, 2, T(3) * noise_m), motion);
  const Truth<T> far = is(motion, Motion::rest) && state.blocks > 27;
  if (any(far)) motion = select(far, even_travel(state, state.four_blocks_m, 8, T(1.5) * noise_m), motion);
  const Truth<T> even = !is(motion, Motion::rest);
  const Truth<T> uneven = !even && state.blocks > 2;
  if (any(uneven)) {
    const T signed_travel_m = block(state, state.block_m, 0) - block(state, state.block_m, 2);
    // A slip: faster than 0.5 mm/s and beyond five times the noise.
    const Truth<T> slips =
        uneven && magnitude(signed_travel_m) > larger(T(0.5e-3) * T(2) * state.block_s, T(5) * noise_m);
    state.unsettled_s = select(slips, T(0.03), state.unsettled_s);
    state.travel_m = select(slips, signed_travel_m, state.travel_m);
  }
  state.travel_m = select(even, select(is(motion, Motion::opening), T(1e-6), T(-1e-6)), state.travel_m);
  state.unsettled_s = select(even, T(0), larger(state.unsettled_s - state.block_s, T(0)));
  const Truth<T> unsettled = state.unsettled_s > T(0.5) * state.block_s;
  state.motion = select(even, motion, select(unsettled, Motions(Motion::transient), Motions(Motion::rest)));
}

}  // namespace detail

/// One sample. A change beyond what the hardest acceleration allows is a fault: its jump is taken out of the signal
/// until the signal jumps back, or for a quarter of a second, after which the signal is believed.
template <class T>
[[gnu::always_inline]] constexpr PositionPoint<T> step(const PositionSensor<T>& sensor, PositionState<T>& state,
                                                       T time_step_s, T position_m, T oil_temperature_K) {
  const T drift_free_m = position_m - sensor.drift_m_per_K * (oil_temperature_K - sensor.drift_free_K);
  state.last_m = select(state.blocks == 0 && state.samples == 0, drift_free_m, state.last_m);
  const T corrected_m = drift_free_m - state.offset_m;
  const T surprise_m = corrected_m - state.last_m - state.step_m;
  const T credible_m =
      T(20) * sensor.noise_m + T(20e-6) + sensor.hardest_acceleration_m_per_s2 * time_step_s * time_step_s;
  T believed_m = corrected_m;
  const Truth<T> jumps = magnitude(surprise_m) > credible_m;
  if (any(jumps)) {
    const T offset_m = state.offset_m + surprise_m;
    state.offset_m = select(jumps, select(magnitude(offset_m) < credible_m, T(0), offset_m), state.offset_m);
    state.fault_s = select(jumps, T(0), state.fault_s);
    believed_m = select(jumps, drift_free_m - state.offset_m, believed_m);
  }
  const Truth<T> faulty = state.offset_m != T(0);
  if (any(faulty)) {
    state.fault_s = select(faulty, state.fault_s + time_step_s, state.fault_s);
    const Truth<T> believes = faulty && state.fault_s > T(0.25) + T(0.5) * time_step_s;
    state.offset_m = select(believes, T(0), state.offset_m);
    believed_m = select(believes, drift_free_m, believed_m);
  }
  state.step_m = limited(believed_m - state.last_m, -credible_m, credible_m);
  state.last_m = believed_m;
  state.sum_m += believed_m;
  state.sum_s += time_step_s;
  state.samples = state.samples + 1;
  const T block_s = T(2e-3);
  in_valves(
      state.sum_s > block_s - T(0.5) * time_step_s,
      state, [&]() __attribute__((always_inline)) { detail::close_block(sensor, state); });
  return {believed_m, state.motion, state.offset_m != T(0), state.travel_m};
}

static_assert(std::is_trivially_copyable_v<PositionState<float>>);

}  // namespace spoolflow::sensor
