#pragma once
/// One-sided CUSUM of standardised scores, one a window: Page (1954), with a limit of Shewhart's for a single score,
/// Lucas (1982). Its average run length without a change follows
/// from a Markov chain of its states, Brook and Evans (1972); from that, the limit for a wanted rate of false alarms.
#include <type_traits>

namespace spoolflow::monitor {

struct Cusum {
  double sum = 0;
  bool raised = false;  ///< latched
};
static_assert(std::is_trivially_copyable_v<Cusum>);

/// `score`: standardised; below `allowance` the sum falls. Raised where the sum passes `limit`, and falls back only
/// below a quarter of it.
constexpr void follow(Cusum& cusum, double score, double allowance, double limit, double at_once = 1e300) {
  if (score > at_once) cusum.sum = 2 * limit;
  cusum.sum += score - allowance;
  if (!(cusum.sum > 0)) cusum.sum = 0;
  if (cusum.sum > 2 * limit) cusum.sum = 2 * limit;  // falls back in a time that does not grow with the alarm's
  if (cusum.sum > limit) cusum.raised = true;
  if (cusum.sum < 0.25 * limit) cusum.raised = false;
}

/// Scores until a false alarm, in the mean, where they are normal with `mean` and variance one. `states`: of the chain.
[[nodiscard]] double average_run_length(double allowance, double limit, double mean = 0, int states = 120);

/// The single score that normal ones exceed once in `run_length`.
[[nodiscard]] double single_limit_for(double run_length);

/// The limit at which that is `run_length` scores.
[[nodiscard]] double limit_for(double allowance, double run_length);

}  // namespace spoolflow::monitor
