#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace spoolflow::validation {

/// Samples [begin, end); none where nothing was recorded for long.
struct Stretch {
  std::size_t begin, end;
};

/// No sample for this many mean steps is a gap: lines break there.
inline constexpr double gap_mean_steps = 25;

/// The longest time between two samples that is no gap.
[[nodiscard]] inline double longest_step_s(std::span<const double> time_s) {
  if (time_s.size() < 2) return std::numeric_limits<double>::infinity();
  return gap_mean_steps * (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
}

/// Stretches of `length` samples, fewer before a gap and at the end; an empty one in each gap.
[[nodiscard]] inline std::vector<Stretch> stretches_of_samples(std::span<const double> time_s, std::size_t length) {
  std::vector<Stretch> out;
  const double longest_s = longest_step_s(time_s);
  for (std::size_t begin = 0; begin < time_s.size();) {
    std::size_t end = begin + 1;
    while (end < time_s.size() && end - begin < length && time_s[end] - time_s[end - 1] <= longest_s) ++end;
    out.push_back({begin, end});
    if (end < time_s.size() && time_s[end] - time_s[end - 1] > longest_s) out.push_back({end, end});
    begin = end;
  }
  return out;
}

}  // namespace spoolflow::validation
