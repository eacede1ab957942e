#pragma once
/// How the spool follows its command, where that is recorded: response time and overshoot of steps.
#include <algorithm>
#include <cmath>
#include <type_traits>

namespace spoolflow::monitor {

/// A change of the command by this share of the stroke within `step_within_s`, after `steady_before_s` without one, is
/// a step; it is judged while the command stays within a tenth of it, for `judged_for_s` at most.
inline constexpr double least_step_share = 0.05;
inline constexpr double step_within_s = 0.02;
inline constexpr double steady_before_s = 0.1;
inline constexpr double judged_for_s = 1;
/// The response is the time until this share of the step is done.
inline constexpr double response_share = 0.9;
/// Newer steps count for at least this share of the mean.
inline constexpr double step_forgetting = 0.05;

struct CommandResponse {
  double steps = 0;         ///< judged so far
  double response_s = 0;    ///< mean time from the step to 90 % of it
  double response2_s2 = 0;  ///< mean square
  double overshoot = 0;     ///< mean of the largest, as a share of the step
  double overshoot2 = 0;    ///< mean square
  // The memory of the step under way.
  double steady_m = 0;  ///< command before
  double steady_s = 0;  ///< for how long it has been so
  double begun_s = -1;  ///< since the step; below 0: none
  double from_m = 0, to_m = 0;
  double reached_s = -1;
  double furthest = 0;  ///< of the step
};
static_assert(std::is_trivially_copyable_v<CommandResponse>);

struct CommandSample {
  double time_step_s;
  double command_m;
  double position_m;
};

namespace detail {

inline void close_step(CommandResponse& state) {
  if (state.begun_s >= 0 && state.reached_s >= 0) {
    ++state.steps;
    const double share = std::max(1 / state.steps, step_forgetting);
    const double over = std::max(state.furthest - 1, 0.0);
    state.response_s += share * (state.reached_s - state.response_s);
    state.response2_s2 += share * (state.reached_s * state.reached_s - state.response2_s2);
    state.overshoot += share * (over - state.overshoot);
    state.overshoot2 += share * (over * over - state.overshoot2);
  }
  state.begun_s = -1;
}

}  // namespace detail

/// A gap: the step under way is not judged.
inline void interrupt(CommandResponse& state) {
  state.begun_s = -1;
  state.steady_s = 0;
}

/// One sample; all numbers finite.
inline void follow(CommandResponse& state, double stroke_m, const CommandSample& sample) {
  const double least_m = least_step_share * stroke_m;
  if (state.begun_s >= 0) {
    state.begun_s += sample.time_step_s;
    if (state.begun_s <= step_within_s) state.to_m = sample.command_m;
    const double step_m = state.to_m - state.from_m;
    if (std::abs(sample.command_m - state.to_m) > 0.1 * std::abs(step_m) || state.begun_s > judged_for_s ||
        std::abs(step_m) < least_m) {
      if (std::abs(step_m) < least_m) state.begun_s = -1;
      detail::close_step(state);
      state.steady_m = sample.command_m;
      state.steady_s = 0;
      return;
    }
    const double done = (sample.position_m - state.from_m) / step_m;
    if (state.reached_s < 0 && done >= response_share) state.reached_s = state.begun_s;
    state.furthest = std::max(state.furthest, done);
    return;
  }
  if (std::abs(sample.command_m - state.steady_m) < 0.1 * least_m) {
    state.steady_s += sample.time_step_s;
    return;
  }
  if (state.steady_s >= steady_before_s) {
    state.begun_s = 0;
    state.from_m = state.steady_m;
    state.to_m = sample.command_m;
    state.reached_s = -1;
    state.furthest = 0;
  } else {
    state.steady_m = sample.command_m;
    state.steady_s = 0;
  }
}

/// One standard deviation of a mean of so many, from mean and mean square.
inline double deviation_of_mean(double mean, double square, double count) {
  const double counted = std::min(count, 1 / step_forgetting);
  return counted > 1 ? std::sqrt(std::max(square - mean * mean, 0.0) / (counted - 1)) : mean;
}

}  // namespace spoolflow::monitor
