#include "spoolflow/plausibility/signals/coil_signals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/numerics/largest_magnitude.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

struct Coil {
  Channel current, voltage;
};
constexpr std::array coils{Coil{Channel::current, Channel::voltage}, Coil{Channel::current_a, Channel::voltage_a},
                           Coil{Channel::current_b, Channel::voltage_b}};

constexpr double leap_block_s = 1, short_block_s = 0.05;
constexpr std::size_t leap_blocks = 12;      ///< on either side of a leap
constexpr double longest_leap_s = 36;        ///< that these take together, with rests between them
constexpr double least_current_share = 0.2;  ///< of the largest current: below it a zero's error counts
constexpr double least_leap = 0.03;          ///< of the resistance; sound runs have less than 2.5 %
constexpr double least_certainty = 4;        ///< a leap over the uncertainty of both medians
constexpr double no_voltage_share = 0.01;    ///< of the largest voltage
constexpr double settling_s = 0.3;           ///< some ten time constants of a coil
constexpr std::size_t fewest_idle_blocks = 10;
constexpr double zero_current_share = 0.006;  ///< of the largest current; sound runs have 0.05 %
constexpr double most_driven_share = 0.25;    ///< of the current, by the voltage that is left
constexpr double supply_range = 0.05;         ///< of the supply's voltage
constexpr std::size_t fewest_supply_blocks = 40;
constexpr double supply_block_s = 0.25;      ///< some five time constants of a coil
constexpr double least_current_ratio = 1.5;  ///< copper alone makes 1.2

/// Means of one coil over equal times; blocks in which a channel is missing are left out.
struct Means {
  std::vector<double> begin_s, current_A, voltage_V;

  [[nodiscard]] std::size_t size() const { return begin_s.size(); }
};

Means means_of(const Recording& run, Channel current, Channel voltage, double block_s) {
  Means out;
  if (!run.has(Channel::time) || !run.has(current) || !run.has(voltage)) return out;
  const std::vector<double>&time_s = run.column(Channel::time), &current_A = run.column(current),
        &voltage_V = run.column(voltage);
  double begin_s = NAN, sum_A = 0, sum_V = 0, count = 0;
  const auto close = [&] {
    if (count > 0) {
      out.begin_s.push_back(begin_s);
      out.current_A.push_back(sum_A / count);
      out.voltage_V.push_back(sum_V / count);
    }
    sum_A = sum_V = count = 0;
  };
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    if (!(std::abs(time_s[k] - begin_s) < block_s)) {
      close();
      begin_s = time_s[k];
    }
    if (!std::isfinite(current_A[k] + voltage_V[k])) continue;
    sum_A += current_A[k];
    sum_V += voltage_V[k];
    ++count;
  }
  close();
  return out;
}

struct Resistances {
  std::vector<double> begin_s, log_Ohm;  ///< natural logarithm
};
Resistances resistances(const Means& means) {
  Resistances out;
  const double least_A = least_current_share * numerics::largest_magnitude(means.current_A);
  for (std::size_t k = 0; k < means.size(); ++k) {
    if (!(means.current_A[k] > least_A) || !(means.voltage_V[k] > 0)) continue;
    out.begin_s.push_back(means.begin_s[k]);
    out.log_Ohm.push_back(std::log(means.voltage_V[k] / means.current_A[k]));
  }
  return out;
}

struct Leap {
  double at_s = 0, before_Ohm = 0, after_Ohm = 0;
  double certainty = 0;  ///< the leap over its uncertainty
  int apart = 0;         ///< values on their own side of its middle
};

Leap leap_at(const Resistances& of, std::size_t k) {
  const std::span all(of.log_Ohm);
  const std::span before = all.subspan(k - leap_blocks, leap_blocks), after = all.subspan(k, leap_blocks);
  const double one = numerics::median({before.begin(), before.end()}),
               other = numerics::median({after.begin(), after.end()});
  const double middle = (one + other) / 2, sign = other > one ? 1 : -1;
  std::vector<double> deviations;
  int apart = 0;
  for (const double value : before) {
    deviations.push_back(std::abs(value - one));
    apart += sign * (value - middle) < 0;
  }
  for (const double value : after) {
    deviations.push_back(std::abs(value - other));
    apart += sign * (value - middle) > 0;
  }
  constexpr double finest = 1e-4;  // of a resistance
  constexpr double deviations_of_median = 1.4826, of_a_median = 1.2533;
  const double deviation = deviations_of_median * std::max(numerics::median(deviations), finest);
  const double uncertainty = of_a_median * deviation * std::sqrt(2.0 / static_cast<double>(leap_blocks));
  return {of.begin_s[k], std::exp(one), std::exp(other), std::abs(other - one) / uncertainty, apart};
}

/// The one that parts its sides best.
std::optional<Leap> surest_leap(const Resistances& of) {
  std::optional<Leap> best;
  for (std::size_t k = leap_blocks; k + leap_blocks <= of.log_Ohm.size(); ++k) {
    if (!(of.begin_s[k + leap_blocks - 1] - of.begin_s[k - leap_blocks] < longest_leap_s)) continue;
    const Leap leap = leap_at(of, k);
    if (std::abs(std::log(leap.after_Ohm / leap.before_Ohm)) < least_leap || leap.certainty < least_certainty) continue;
    if (!best || std::pair(leap.apart, leap.certainty) > std::pair(best->apart, best->certainty)) best = leap;
  }
  return best;
}

}  // namespace

std::vector<std::string> resistance_leaps(const Recording& means) {
  std::vector<std::string> out;
  for (const auto& [current, voltage] : coils) {
    const auto leap = surest_leap(resistances(means_of(means, current, voltage, leap_block_s)));
    if (!leap) continue;
    out.push_back(fmt::format(
        "{} over {} leaps from {:.3g} to {:.3g} Ohm at {:.0f} s, by {:+.1f} %, and no coil's copper changes so within "
        "seconds: the scale of one of them changes, as by an amplifier's range or a loose contact; record it again, or "
        "cut off the part before or behind",
        recording::name(voltage), recording::name(current), leap->before_Ohm, leap->after_Ohm, leap->at_s,
        100 * (leap->after_Ohm / leap->before_Ohm - 1)));
  }
  return out;
}

std::vector<std::string> currents_without_voltage(const Recording& run) {
  std::vector<std::string> out;
  for (const auto& [current, voltage] : coils) {
    const Means means = means_of(run, current, voltage, short_block_s);
    const std::vector<double> log_Ohm = resistances(means_of(run, current, voltage, leap_block_s)).log_Ohm;
    const double most_V = no_voltage_share * numerics::largest_magnitude(means.voltage_V);
    std::vector<double> left_A, left_V;
    double since_s = NAN;
    for (std::size_t k = 0; k < means.size(); ++k) {
      if (std::abs(means.voltage_V[k]) > most_V) {
        since_s = NAN;
        continue;
      }
      if (std::isnan(since_s)) since_s = means.begin_s[k];
      if (means.begin_s[k] - since_s < settling_s) continue;
      left_A.push_back(means.current_A[k]);
      left_V.push_back(means.voltage_V[k]);
    }
    if (left_A.size() < fewest_idle_blocks || log_Ohm.empty()) continue;
    const double zero_A = numerics::median(left_A);
    const double driven_A = numerics::median(left_V) / std::exp(numerics::median(log_Ohm));
    const double largest_A = numerics::largest_magnitude(means.current_A);
    if (std::abs(zero_A) < zero_current_share * largest_A || std::abs(driven_A) > most_driven_share * std::abs(zero_A))
      continue;
    out.push_back(fmt::format(
        "{} stands at {:+.3f} A wherever the coil has had no {} for {:.1f} s, {:.1f} % of its largest value: the zero "
        "of its clamp or amplifier is off, and what the forces make of it looks like a coil or spring that has "
        "changed; set the clamp to zero and record it again, or take {:+.3f} A off",
        recording::name(current), zero_A, recording::name(voltage), settling_s, 100 * std::abs(zero_A) / largest_A,
        zero_A));
  }
  return out;
}

std::string supply_voltage(const Recording& run) {
  for (const auto& [current, voltage] : coils) {
    const Means means = means_of(run, current, voltage, supply_block_s);
    if (means.size() < fewest_supply_blocks) continue;
    const auto [lowest_V, highest_V] = std::ranges::minmax(means.voltage_V);
    const double low_A = numerics::quantile(means.current_A, 0.05), high_A = numerics::quantile(means.current_A, 0.95);
    if (!(lowest_V > 0) || highest_V - lowest_V > supply_range * highest_V ||
        high_A < least_current_ratio * std::max(low_A, 0.0) || !(high_A > 0))
      continue;
    return fmt::format(
        "{} stays near {:.1f} V while {} goes from {:.2g} to {:.2g} A: the supply's voltage, not the coil's; record it "
        "at the coil's terminals, averaged over the PWM's period, or leave the channel out",
        recording::name(voltage), numerics::median(means.voltage_V), recording::name(current), low_A, high_A);
  }
  return {};
}

}  // namespace spoolflow::plausibility
