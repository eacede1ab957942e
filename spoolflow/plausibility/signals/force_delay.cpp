#include "spoolflow/plausibility/signals/force_delay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/plausibility/signals/coil_blocks.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

constexpr double block_s = 0.001, longest_step_s = 0.00051, longest_gap_s = 0.02, held_m = 50e-6;
constexpr std::size_t fewest_blocks = 150, most_power_blocks = 40'000;
constexpr std::ptrdiff_t earliest = -10, latest = 60;  ///< blocks
constexpr std::array lags_s{0.0, 0.001, 0.002, 0.004, 0.007, 0.012, 0.02, 0.035, 0.06};
constexpr double usual_s = 0.0015;
constexpr double least_correlation = 0.9, least_gain = 0.05;

/// A stretch of one test at a held position, in blocks.
struct Stretch {
  std::vector<double> power_W;  ///< into the coil's field
  std::vector<double> force_rate_N_per_s;
};

/// Means over blocks; empty where some hold no sample.
std::vector<double> block_means_of(const std::vector<double>& time_s, const std::vector<double>& values,
                                   std::size_t from, std::size_t to) {
  std::vector<double> sums, counts;
  for (std::size_t k = from; k < to; ++k) {
    constexpr double rounding = 1e-6;
    const auto block = static_cast<std::size_t>((time_s[k] - time_s[from]) / block_s + rounding);
    if (block >= sums.size()) {
      if (block > sums.size()) return {};
      sums.push_back(0);
      counts.push_back(0);
    }
    sums[block] += values[k];
    ++counts[block];
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= counts[k];
  return sums;
}

Stretch stretch_of(const std::vector<double>& current_A, const std::vector<double>& voltage_V,
                   const std::vector<double>& force_N) {
  const double resistance_Ohm = resistance_Ohm_of(current_A, voltage_V);
  Stretch out;
  for (std::size_t k = 2; k + 2 < current_A.size(); ++k) {
    out.power_W.push_back(current_A[k] * induced_V(current_A, voltage_V, resistance_Ohm, k));
    out.force_rate_N_per_s.push_back(rate(force_N, k, block_s));
  }
  return out;
}

std::vector<Stretch> stretches_of(const Recording& run) {
  const std::vector<double>&time_s = run.column(Channel::time), &position_m = run.column(Channel::position),
        &test = run.column(Channel::test);
  std::vector<Stretch> out;
  std::size_t blocks = 0;
  for (std::size_t from = 0, k = 1; k <= time_s.size() && blocks < most_power_blocks; ++k) {
    const bool goes_on = k < time_s.size() && time_s[k] > time_s[k - 1] && time_s[k] - time_s[k - 1] < longest_gap_s &&
                         (test.empty() || test[k] == test[from]) &&
                         (position_m.empty() || std::abs(position_m[k] - position_m[from]) < held_m);
    if (goes_on) continue;
    const auto steps = static_cast<double>(k - 1 - from);
    if (time_s[k - 1] - time_s[from] <= steps * longest_step_s) {
      const auto means = [&](Channel channel) { return block_means_of(time_s, run.column(channel), from, k); };
      Stretch found = stretch_of(means(Channel::current), means(Channel::voltage), means(Channel::force));
      if (found.power_W.size() >= fewest_blocks) {
        blocks += found.power_W.size();
        out.push_back(std::move(found));
      }
    }
    from = k;
  }
  return out;
}

/// Of the force's rate so many blocks later with the power as a first-order lag shows it: the mean over all stretches,
/// each by its power.
class Correlation {
 public:
  Correlation(const std::vector<Stretch>& stretches, double lag_s) : stretches_(stretches) {
    const double share = lag_s > 0 ? numerics::lag_share(block_s, lag_s) : 1;
    for (const Stretch& each : stretches) {
      std::vector<double>& shown = shown_.emplace_back(each.power_W);
      for (std::size_t k = 1; k < shown.size(); ++k) shown[k] = shown[k - 1] + share * (shown[k] - shown[k - 1]);
    }
  }
  [[nodiscard]] double at(std::ptrdiff_t delay) const {
    double sum = 0, weights = 0;
    for (std::size_t s = 0; s < shown_.size(); ++s) {
      const std::vector<double>&power = shown_[s], &rate = stretches_[s].force_rate_N_per_s;
      double both = 0, power2 = 0, rate2 = 0;
      for (auto k = static_cast<std::size_t>(-earliest); k + latest < power.size(); ++k) {
        const double later = rate[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(k) + delay)];
        both += power[k] * later;
        power2 += power[k] * power[k];
        rate2 += later * later;
      }
      if (!(power2 > 0 && rate2 > 0)) continue;
      sum += power2 * both / std::sqrt(power2 * rate2);
      weights += power2;
    }
    return weights > 0 ? sum / weights : 0;
  }

 private:
  const std::vector<Stretch>& stretches_;
  std::vector<std::vector<double>> shown_;
};

}  // namespace

std::string late_force(const Recording& run) {
  for (const Channel channel : {Channel::time, Channel::current, Channel::voltage, Channel::force})
    if (!run.has(channel) || run.column(channel).size() < 2) return {};
  const std::vector<Stretch> stretches = stretches_of(run);
  if (stretches.empty()) return {};
  numerics::MeterLag found;
  double best = 0, unshifted = 0;
  for (const double lag_s : lags_s) {
    const Correlation correlation(stretches, lag_s);
    for (std::ptrdiff_t delay = earliest; delay <= latest; ++delay) {
      const double now = correlation.at(delay);
      if (lag_s == 0 && delay == 0) unshifted = now;
      if (now <= best) continue;
      best = now;
      found = {static_cast<double>(delay) * block_s, lag_s};
    }
  }
  const double late_s = found.dead_time_s + found.lag_s;
  if (std::abs(late_s) < usual_s || best < least_correlation || best - unshifted < least_gain) return {};
  constexpr double ms_per_s = 1e3;
  return fmt::format(
      "force comes {:.0f} ms {} the coil's voltage and current, whose flux makes it (as of {:.0f} ms of delay and a "
      "filter of {:.0f} ms): a filter of the load cell's amplifier, or two recorders; dynamic force then calibrates "
      "eddy currents that are not there: set the filter to 500 Hz or more, or record all with one clock",
      ms_per_s * std::abs(late_s), late_s > 0 ? "behind" : "before", ms_per_s * found.dead_time_s,
      ms_per_s * found.lag_s);
}

}  // namespace spoolflow::plausibility
