#include "spoolflow/validation/phases.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::validation {
namespace {

constexpr double moving_rate_per_s = 0.01;  // share of the stroke a second
constexpr double open_share = 0.01;
constexpr double half_open_share = 0.5;
constexpr double reversal_s = 2.0;
constexpr double half_window_s = 0.25;  // for rates of a measured, noisy position

/// Marks the samples within `reversal_s` of any turn.
std::vector<bool> near_turns(std::span<const double> time_s, const std::vector<double>& turns_s) {
  std::vector<bool> near(time_s.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    while (next < turns_s.size() && turns_s[next] < time_s[k]) ++next;
    near[k] = (next < turns_s.size() && turns_s[next] - time_s[k] <= reversal_s) ||
              (next > 0 && time_s[k] - turns_s[next - 1] <= reversal_s);
  }
  return near;
}

/// `share`: > 0 opens P to B, < 0 P to A: on either side the spool opens away from the centre. `longest_turn_s`: how
/// long the rate may be zero between two directions that make one turn.
Phases phases_of_rate(std::span<const double> time_s, std::span<const double> share, const std::vector<double>& rate,
                      double longest_turn_s) {
  Phases out;
  std::vector<double> turns_s;
  std::size_t moved = 0;
  for (std::size_t k = 0; k < rate.size(); ++k) {
    const bool moving = std::abs(rate[k]) > moving_rate_per_s;
    out.moving.push_back(moving);
    out.opening.push_back(moving && (share[k] < 0 ? rate[k] < 0 : rate[k] > 0));
    out.rest.push_back(!moving && std::abs(share[k]) > open_share);
    if (k == 0) continue;
    const bool stops_or_starts = moving != out.moving[k - 1] && std::abs(share[k]) > half_open_share;
    const bool turns = rate[k] * rate[k - 1] < 0 ||
                       (moving && rate[k] * rate[moved] < 0 && time_s[k] - time_s[moved] <= longest_turn_s);
    if (stops_or_starts || turns) turns_s.push_back(time_s[k]);
    if (moving) moved = k;
  }
  out.reversal = near_turns(time_s, turns_s);
  return out;
}

/// Sums before each sample, so that the mean over any stretch is two subtractions.
std::vector<double> running_sum(std::span<const double> values) {
  std::vector<double> sums(values.size() + 1, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) sums[k + 1] = sums[k] + values[k];
  return sums;
}

std::vector<double> held_share(std::span<const double> position_m, double stroke_m) {
  std::vector<double> share;
  double last = 0;
  for (const double x : position_m) {
    if (!std::isnan(x)) last = x / stroke_m;
    share.push_back(last);
  }
  return share;
}

}  // namespace

Phases phases_of_command(std::span<const double> time_s, std::span<const double> position_set) {
  std::vector<double> rate(time_s.size(), 0.0);
  for (std::size_t k = 1; k < rate.size(); ++k) {
    rate[k] = (position_set[k] - position_set[k - 1]) / std::max(time_s[k] - time_s[k - 1], 1e-9);
  }
  return phases_of_rate(time_s, position_set, rate, 0);
}

Phases phases_of_position(std::span<const double> time_s, std::span<const double> position_m, double stroke_m) {
  const std::size_t n = time_s.size();
  const std::vector<double> share = held_share(position_m, stroke_m);
  const std::vector<double> share_sum = running_sum(share);
  const std::vector<double> time_sum = running_sum(time_s);
  std::vector<double> rate(n, 0.0);
  std::size_t begin = 0;
  std::size_t end = 0;
  for (std::size_t k = 0; k < n; ++k) {
    while (time_s[k] - time_s[begin] > half_window_s) ++begin;
    while (end < n && time_s[end] - time_s[k] <= half_window_s) ++end;
    if (begin == k || end == k + 1) continue;
    const auto mean = [](const std::vector<double>& sums, std::size_t from, std::size_t to) {
      return (sums[to] - sums[from]) / static_cast<double>(to - from);
    };
    const double rise = mean(share_sum, k, end) - mean(share_sum, begin, k);
    const double step_s = mean(time_sum, k, end) - mean(time_sum, begin, k);
    rate[k] = rise / std::max(step_s, 1e-9);
    if (std::abs(rate[k]) <= moving_rate_per_s) rate[k] = 0;  // noise has no direction that could turn
  }
  Phases out = phases_of_rate(time_s, share, rate, 2 * half_window_s);
  out.from_measured_position = true;
  return out;
}

}  // namespace spoolflow::validation
