#include "spoolflow/plausibility/coil_currents.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/valve_curves.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

struct Sides {
  double lowest = 0, highest = 0;
  bool both = false;  ///< of zero, each for a share of the blocks

  [[nodiscard]] double largest() const { return std::max(-lowest, highest); }
};
Sides sides_of(const std::vector<double>& values) {
  Sides out;
  for (const double value : values) {
    out.lowest = std::fmin(out.lowest, value);
    out.highest = std::fmax(out.highest, value);
  }
  const double least = signed_current_share * out.largest();
  double above = 0, below = 0;
  for (const double value : values) {
    above += value > least;
    below += value < -least;
  }
  out.both = std::min(above, below) > signed_blocks_share * static_cast<double>(values.size());
  return out;
}

/// Of the blocks that have both; 0 where one of them hardly changes beside its size.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double count = 0, sum_a = 0, sum_b = 0, a2 = 0, b2 = 0, product = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!std::isfinite(a[k] + b[k])) continue;
    ++count;
    sum_a += a[k];
    sum_b += b[k];
    a2 += squared(a[k]);
    b2 += squared(b[k]);
    product += a[k] * b[k];
  }
  if (count < least_blocks) return 0;
  constexpr double hardly = 0.01;
  const double of_a = a2 - squared(sum_a) / count, of_b = b2 - squared(sum_b) / count;
  if (!(of_a > hardly * a2) || !(of_b > hardly * b2)) return 0;
  return (product - sum_a * sum_b / count) / std::sqrt(of_a * of_b);
}

}  // namespace

std::string signed_coil_currents(const Recording& means) {
  constexpr std::array pairs{std::pair{Channel::current_a, Channel::current_b},
                             std::pair{Channel::voltage_a, Channel::voltage_b}};
  const Recording slow = longer_blocks(means);  // without dither, which both coils may have
  for (const auto& [channel_a, channel_b] : pairs) {
    const std::vector<double>&a = slow.column(channel_a), &b = slow.column(channel_b);
    if (a.empty() || a.size() != b.size()) continue;
    const double together = correlation(a, b);
    const Sides of_a = sides_of(a), of_b = sides_of(b);
    const bool negative = together < -one_signal_correlation && (of_a.both || of_b.both);
    if (!(together > one_signal_correlation) && !negative) continue;
    return fmt::format(
        "{} and {} {} all along (correlation {:.3f}, {:.3g} to {:.3g} {}): one signal stands in both columns; record "
        "each "
        "coil's own, or give each channel its own column in the channel map",
        recording::name(channel_a), recording::name(channel_b), negative ? "are each other's negative" : "go together",
        together, of_a.lowest, of_a.highest, channel_a == Channel::current_a ? "A" : "V");
  }
  const std::array currents{Channel::current_a, Channel::current_b, Channel::current};
  std::array<Sides, currents.size()> sides;
  std::ranges::transform(currents, sides.begin(), [&](Channel each) { return sides_of(slow.column(each)); });
  // A coil that stays off has noise on both sides of zero.
  const double largest_A = std::ranges::max(sides, {}, &Sides::largest).largest();
  const double least_A = std::max(signed_current_share * largest_A, least_signed_A);
  const std::vector<double>& position_m = slow.column(Channel::position);
  const bool one_coil = !position_m.empty() && !sides_of(position_m).both;
  for (std::size_t k = 0; k < currents.size(); ++k) {
    if (!sides[k].both || sides[k].largest() < least_A) continue;
    const std::string goes =
        fmt::format("{} goes from {:.3g} to {:.3g} A", recording::name(currents[k]), sides[k].lowest, sides[k].highest);
    if (currents[k] == Channel::current && one_coil)
      return fmt::format(
          "{}, {:.3g} A on average, while the spool keeps to one side, and a coil's current has one direction: an "
          "input that is AC-coupled, or a high-pass, takes its mean away; switch it to DC and record it again",
          goes, mean_of_numbers(slow.column(Channel::current)));
    return goes +
           ", and a coil's current has one direction: a signed current of both coils stands in its column; record each "
           "coil's own as current_a and current_b, each >= 0";
  }
  return {};
}

}  // namespace spoolflow::plausibility
