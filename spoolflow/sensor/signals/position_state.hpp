#pragma once
/// What a position track keeps, and what it answers to a sample; position_track.hpp says how.
#include <array>
#include <cstdint>
#include <type_traits>

#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// Length of the blocks over which the position is averaged [s]: 20 samples at 10 kHz, 2 at 1 kHz, one at 500 Hz. Where
/// dither frees the spool a block is a period, in which its dither motion cancels.
inline constexpr double block_length_s = 2e-3;
/// Sliding is found from windows of so many blocks, three in a row: short ones at the pace of a duty cycle ...
inline constexpr int short_window_blocks = 2;
/// ... which must travel further than so many standard deviations of the noise, ...
inline constexpr double short_window_deviations = 3;
/// ... or long ones, of means over four blocks, for a spool that creeps.
inline constexpr int long_window_blocks = 8;
inline constexpr double long_window_deviations = 1.5;
/// Windows travel evenly where the longest is no more than so many times the shortest, and a threshold more.
inline constexpr double even_travel_ratio = 4;
/// The newest is no less than one over this of the others, less a threshold: a spool that slows down more is about to
/// stop, and friction to fall off its limit.
inline constexpr double slowing_travel_ratio = 2;
/// A slip is faster than this [m/s] ...
inline constexpr double slip_speed_m_per_s = 0.5e-3;
/// ... and moves by more than so many standard deviations of the noise; ...
inline constexpr double slip_deviations = 5;
/// ... friction and inertia are in motion for so long [s] after it.
inline constexpr double slip_settling_s = 0.03;
/// A change of the signal is credible up to so many standard deviations of the noise and this much more [m], besides
/// what the largest acceleration allows.
inline constexpr double credible_jump_deviations = 20;
inline constexpr double credible_jump_m = 20e-6;
/// The noise is the calibrated one, or that which the signal has over this factor, where that is more: the spool's
/// motion adds a little to it, too. With 1.2 less of it is learnt than the band needs: of ramp_60bar with 1.5 um of
/// noise more 79 % instead of 100 % inside.
inline constexpr double position_noise_excess = 1.12;
/// What the signal has is followed by this share of the calibrated noise in each block: in a second or so. A quarter of
/// that learns too late where a run begins.
inline constexpr double position_noise_follow_share = 0.004;
/// An armature that moves changes current or voltage of its coil, by more than this share of the largest current, and
/// of the voltage that holds it: where neither changed, ...
inline constexpr double quiet_current_share = 0.005;
inline constexpr double quiet_voltage_share = 0.03;
/// ... no jump is credible by more than this [m], however long the step in which a spool could accelerate.
inline constexpr double quiet_jump_m = 60e-6;
/// A current that changes by more than this share of the largest current a second [1/s] moves the spool harder than any
/// other: ...
inline constexpr double calm_current_rate_per_s = 50;
/// ... for each so much more [1/s] once more the largest acceleration is credible, ...
inline constexpr double hard_current_rate_per_s = 20;
/// ... for some milliseconds: the change is forgotten by this share of the largest current a second [1/s].
inline constexpr double current_change_forgotten_per_s = 20;
/// A jump that lasts longer than this [s] is accepted, but marked until that [s]: where the signal jumps back
/// meanwhile, it was the jump that was wrong.
inline constexpr double longest_position_fault_s = 0.25;
inline constexpr double longest_position_doubt_s = 2.5;
/// A block under dither ends after so long [s], whole period or not.
inline constexpr double longest_dither_block_s = 0.015;
inline constexpr double fastest_m_per_s = 10;         ///< no spool moves faster
inline constexpr double velocity_smoothing_s = 0.03;  ///< of the velocity
inline constexpr double direction_only_m = 1e-6;      ///< size of a travel that shows a direction and nothing else

/// Changes of the coil's current and voltage from one sample to the next, >= 0, that show no motion.
template <class T>
struct QuietCoil {
  T current_A;
  T voltage_V;
};

enum class Motion : std::uint8_t {
  rest,       ///< nothing moves by more than noise
  transient,  ///< a slip, or the end of one: friction and inertia are in motion
  opening,    ///< slides evenly: friction has its full size and its sign is known
  closing,
};

constexpr bool slides(Motion motion) {
  return motion == Motion::opening || motion == Motion::closing;
}

inline constexpr int position_blocks = 32;  ///< of means over four blocks, for the long windows
inline constexpr int short_blocks = 8;      ///< of means over one, for the short ones

/// The noise of the signal, over the calibrated one.
template <class T>
struct PositionNoise {
  T median{};  ///< of the size of second differences
  T times{};   ///< standard deviation of one sample: 1, or what the median shows where that is more
};

/// What the coil showed.
template <class T>
struct CoilSignal {
  T current_A{};  ///< in the last sample
  T voltage_V{};
  T change_A{};  ///< largest change of the current from one sample to the next, >= 0, forgotten in milliseconds
};

/// Trivially copyable memory of a track. The rings hold means over blocks of some milliseconds, newest at `newest`;
/// each of the short one's stands twice, so that those before the newest lie in a row.
template <class T>
struct PositionState {
  std::array<T, 2 * short_blocks> block_m{};
  std::array<T, position_blocks> four_blocks_m{};  ///< means of the block and the three before
  T sum_m{};
  T sum_s{};
  T block_s{};
  T per_block_samples{};  ///< 1 / samples in a block
  T last_m{};
  T step_m{};  ///< last accepted change
  PositionNoise<T> noise{};
  CoilSignal<T> coil{};
  T offset_m{};               ///< what an acquisition fault adds to the signal
  T elsewhere_m{};            ///< where the spool is, from there, if the jump is the other way about than taken
  T fault_s{};                ///< how long ago the fault began; 0: there is none
  T unsettled_s{};            ///< time until a slip counts as over
  T travel_m{};               ///< over the last blocks of a motion, sign of the velocity
  T velocity_m_per_s{};       ///< smoothed
  T acceleration_m_per_s2{};  ///< between the first and the last of three short windows
  bool velocity_due{};        ///< with the next sample, which has less else to do
  bool lone{};                ///< a block is one sample
  int samples{};
  int newest{};
  int blocks{};
  Motion motion{};  ///< at rest
};

/// Where this sample stands among the blocks of positions.
template <class T>
struct PositionBlock {
  bool closed{};   ///< this sample closed a block
  bool follows{};  ///< the sample before did
  bool lone{};     ///< a block is one sample, or none has closed yet
  bool even{};     ///< every second sample; of those that follow a block every second, too
  T length_s{};    ///< of the last block
};

template <class T>
struct PositionPoint {
  T position_m;  ///< free of drift and faults
  Motion motion;
  T travel_m;            ///< sign of the velocity of `motion`
  T velocity_m_per_s{};  ///< smoothed
  T acceleration_m_per_s2{};
  T noise_times{};  ///< the signal's noise over the calibrated one, >= 1
  PositionBlock<T> block{};
  T side{1};  ///< sign of the valve's position > 0 on the side from which this is seen
};

/// Whether a jump of the signal is taken out of the position, or marked.
template <class T>
constexpr bool is_doubted(const PositionState<T>& state) {
  return !is_zero(state.fault_s);
}
/// Then: where the spool is if the jump is the other way about than taken [m], in the signs of `point`.
template <class T>
constexpr T elsewhere_m(const PositionState<T>& state, const PositionPoint<T>& point) {
  return point.position_m + point.side * state.elsewhere_m;
}

static_assert(std::is_trivially_copyable_v<PositionState<float>>);

}  // namespace spoolflow::sensor
