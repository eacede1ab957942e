#include "spoolflow/validation/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spoolflow/validation/stretches.hpp"

namespace spoolflow::validation {
namespace {

/// Samples [begin, end) of one stretch of time; `after_gap`: nothing was recorded for long before it.
struct StretchOfTime {
  std::size_t begin, end;
  bool after_gap;
};

std::vector<StretchOfTime> stretches_of(std::span<const double> time_s, std::size_t count) {
  std::vector<StretchOfTime> out;
  if (time_s.empty()) return out;
  const std::size_t n = time_s.size();
  const double duration_s = time_s.back() - time_s.front();
  const double gap_s = longest_step_s(time_s);
  const double width_s = n <= 2 * count ? 0 : duration_s / static_cast<double>(count);
  std::size_t begin = 0;
  bool after_gap = false;
  for (std::size_t k = 1; k <= n; ++k) {
    const bool gap = k < n && time_s[k] - time_s[k - 1] > gap_s;
    if (k < n && !gap && time_s[k] - time_s[begin] < width_s) continue;
    out.push_back({begin, k, after_gap});
    begin = k;
    after_gap = gap;
  }
  return out;
}

}  // namespace

Line thinned(std::span<const double> time_s, std::span<const float> value, std::size_t stretches) {
  Line out;
  const auto keep = [&](std::size_t k, float y) {
    out.time_s.push_back(time_s[k]);
    out.value.push_back(y);
  };
  for (const StretchOfTime& stretch : stretches_of(time_s, stretches)) {
    if (stretch.after_gap) keep(stretch.begin, no_value);
    std::size_t lowest = stretch.end;
    std::size_t highest = stretch.end;
    for (std::size_t k = stretch.begin; k < stretch.end; ++k) {
      if (std::isnan(value[k])) continue;
      if (lowest == stretch.end || value[k] < value[lowest]) lowest = k;
      if (highest == stretch.end || value[k] > value[highest]) highest = k;
    }
    if (lowest == stretch.end) {
      keep(stretch.begin, no_value);
      continue;
    }
    const auto [first, second] = std::minmax(lowest, highest);
    keep(first, value[first]);
    if (second != first) keep(second, value[second]);
  }
  return out;
}

Ribbon thinned_band(std::span<const double> time_s, std::span<const float> lower, std::span<const float> upper,
                    std::size_t stretches) {
  Ribbon out;
  const auto keep = [&](std::size_t k, float low, float high) {
    out.time_s.push_back(time_s[k]);
    out.lower.push_back(low);
    out.upper.push_back(high);
  };
  for (const StretchOfTime& stretch : stretches_of(time_s, stretches)) {
    if (stretch.after_gap) keep(stretch.begin, no_value, no_value);
    float low = no_value;
    float high = no_value;
    for (std::size_t k = stretch.begin; k < stretch.end; ++k) {
      low = std::fmin(low, lower[k]);  // fmin and fmax pass over NaN
      high = std::fmax(high, upper[k]);
    }
    keep(stretch.begin, low, high);
  }
  return out;
}

}  // namespace spoolflow::validation
