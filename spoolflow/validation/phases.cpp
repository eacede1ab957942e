#include "spoolflow/validation/phases.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/numerics/median.hpp"

namespace spoolflow::validation {
namespace {

constexpr double moving_rate_per_s = 0.01;  // share of the stroke a second
constexpr double open_share = 0.01;
constexpr double half_open_share = 0.5;
constexpr double reversal_s = 2.0;
constexpr double slow_half_window_s = 0.25, fast_half_window_s = 0.02;
constexpr double fast_rate_per_s = 0.1, noise_deviations = 5, whole_window = 0.9;

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

/// `share`: > 0 opens P to B, < 0 P to A: on either side the spool opens away from the centre.
Phases phases_of_rate(std::span<const double> time_s, std::span<const double> share, const std::vector<double>& rate) {
  constexpr double longest_turn_s = 2 * slow_half_window_s;  // without motion between two directions that make one turn
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

/// Standard deviation of a single sample's noise, from second differences, which no even motion has; the median forgets
/// those that are faster.
double noise_of(const std::vector<double>& share) {
  constexpr std::size_t most = 20'000;
  constexpr double median_over_deviation = 0.6745, second_difference = 2.449;  // of normal noise; sqrt(6)
  const std::size_t stride = share.size() / most + 1;
  std::vector<double> bends;
  for (std::size_t k = 1; k + 1 < share.size(); k += stride) {
    bends.push_back(std::abs(share[k + 1] - 2 * share[k] + share[k - 1]));
  }
  return bends.empty() ? 0 : numerics::median(std::move(bends)) / median_over_deviation / second_difference;
}

/// Rates at the samples: the mean over the window after each less that over the window before it.
class WindowRates {
 public:
  WindowRates(std::span<const double> time_s, const std::vector<double>& values)
      : time_s_(time_s), sum_(running_sum(values)), time_sum_(running_sum(time_s)) {}

  struct Rate {
    double per_s = 0;
    double time_apart_s = 0;  ///< 0: the window holds no other sample
    std::size_t fewest = 0;   ///< samples in the smaller of both halves
  };
  /// `k` must not fall from call to call.
  Rate at(std::size_t k, double half_window_s) {
    while (time_s_[k] - time_s_[begin_] > half_window_s) ++begin_;
    while (end_ < time_s_.size() && time_s_[end_] - time_s_[k] <= half_window_s) ++end_;
    if (begin_ == k || end_ == k + 1) return {};
    const auto mean = [](const std::vector<double>& sums, std::size_t from, std::size_t to) {
      return (sums[to] - sums[from]) / static_cast<double>(to - from);
    };
    const double apart_s = std::max(mean(time_sum_, k, end_) - mean(time_sum_, begin_, k), 1e-9);
    return {(mean(sum_, k, end_) - mean(sum_, begin_, k)) / apart_s, apart_s, std::min(end_ - k, k - begin_)};
  }

 private:
  std::span<const double> time_s_;
  std::vector<double> sum_, time_sum_;
  std::size_t begin_ = 0, end_ = 0;
};

/// Rates where the spool moves fast, else 0.
std::vector<double> fast_rates(std::span<const double> time_s, const std::vector<double>& share) {
  const double noise = noise_of(share);
  WindowRates windows(time_s, share);
  std::vector<double> out(share.size(), 0.0);
  for (std::size_t k = 0; k < share.size(); ++k) {
    const WindowRates::Rate rate = windows.at(k, fast_half_window_s);
    if (rate.time_apart_s < whole_window * fast_half_window_s) continue;  // beside ends and gaps
    const double of_noise = noise * std::sqrt(2.0 / static_cast<double>(rate.fewest)) / rate.time_apart_s;
    if (std::abs(rate.per_s) > std::max(fast_rate_per_s, noise_deviations * of_noise)) out[k] = rate.per_s;
  }
  return out;
}

}  // namespace

Phases phases_of_position(std::span<const double> time_s, std::span<const double> position_m, double stroke_m) {
  const std::vector<double> share = held_share(position_m, stroke_m);
  std::vector<double> rate = fast_rates(time_s, share);
  std::vector<double> slow(share.size(), 0.0);  // the way that was not gone fast
  for (std::size_t k = 1; k < share.size(); ++k) {
    slow[k] = slow[k - 1] + (rate[k] == 0 && rate[k - 1] == 0 ? share[k] - share[k - 1] : 0.0);
  }
  WindowRates windows(time_s, slow);
  for (std::size_t k = 0; k < share.size(); ++k) {
    const double slow_rate = windows.at(k, slow_half_window_s).per_s;
    if (rate[k] == 0 && std::abs(slow_rate) > moving_rate_per_s) rate[k] = slow_rate;
  }
  Phases out = phases_of_rate(time_s, share, rate);
  for (const double each : rate) out.velocity_m_per_s.push_back(static_cast<float>(each * stroke_m));
  return out;
}

}  // namespace spoolflow::validation
