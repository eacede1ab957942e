#include "spoolflow/plausibility/reference_shift.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/valve_curves.hpp"

namespace spoolflow::plausibility {
namespace {

constexpr double shift_step_s = 0.05;

/// What the reference leaves of the best multiple of the expected flow, over the reference, both as sums of squares; 1
/// where less than half of the recording has both.
double unexplained(std::span<const double> expected, std::span<const double> reference) {
  double product = 0, expected2 = 0, reference2 = 0, count = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    if (!std::isfinite(expected[k] + reference[k])) continue;
    product += expected[k] * reference[k];
    expected2 += squared(expected[k]);
    reference2 += squared(reference[k]);
    ++count;
  }
  const bool enough = count >= least_blocks && 2 * count >= static_cast<double>(expected.size());
  if (!enough || !(expected2 > 0) || !(reference2 > 0) || !(product > 0)) return 1;
  return 1 - squared(product) / (expected2 * reference2);
}

}  // namespace

std::vector<double> values_later(std::span<const double> time_s, std::span<const double> values, double later_s) {
  std::vector<double> out(values.size(), std::nan(""));
  std::size_t after = 1;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double at_s = time_s[k] + later_s;
    while (after < time_s.size() && time_s[after] < at_s) ++after;
    if (after >= time_s.size() || !(at_s >= time_s.front())) continue;
    const double share = (at_s - time_s[after - 1]) / (time_s[after] - time_s[after - 1]);
    out[k] = values[after - 1] + share * (values[after] - values[after - 1]);
  }
  return out;
}

std::optional<ReferenceShift> reference_shift(std::span<const double> time_s, std::span<const double> expected,
                                              std::span<const double> reference) {
  if (reference.size() < 2 * static_cast<std::size_t>(least_blocks) || expected.size() != reference.size()) return {};
  const double duration_s = time_s.back() - time_s.front();
  if (!(duration_s > 0) || duration_s / static_cast<double>(time_s.size()) > longest_shift_block_s) return {};
  const double most_s = std::min(longest_shift_s, duration_s / 4);
  const auto steps = static_cast<int>(most_s / shift_step_s);
  double best = 1, best_s = 0, best_usual = 1;
  for (int step = -steps; step <= steps; ++step) {
    const double late_s = step * shift_step_s;
    const double left = unexplained(expected, values_later(time_s, reference, late_s));
    if (late_s >= earliest_meter_s && late_s <= latest_meter_s) best_usual = std::min(best_usual, left);
    if (left < best) {
      best = left;
      best_s = late_s;
    }
  }
  const ReferenceShift out{best_s, std::sqrt(best / best_usual)};
  const bool usual = best_s >= earliest_meter_s && best_s <= latest_meter_s;
  if (usual || std::sqrt(best) > most_unexplained || out.residual_share > most_shifted_share) return {};
  return out;
}

std::string shown(const ReferenceShift& shift) {
  return fmt::format(
      "flow_reference comes {:.2f} s {} against position and pressure difference (so shifted it leaves {:.0f} % of "
      "what "
      "it leaves of their flow as it is), and a meter shows a flow at most {:.2g} s late: two clocks, or files joined "
      "at the wrong time; shift its times by {:+.2f} s, or record it with the rest",
      std::abs(shift.late_s), shift.late_s > 0 ? "late" : "early", 100 * shift.residual_share, latest_meter_s,
      -shift.late_s);
}

}  // namespace spoolflow::plausibility
