#include "spoolflow/validation/reference_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace spoolflow::validation {
namespace {

constexpr std::size_t stretches = 20, least_samples = 200;
constexpr double least_variation = 0.05;  // of full scale

/// Sums over samples of estimate x and reference y, in shares of full scale.
struct Sums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(double estimate, double reference) {
    n += 1, x += estimate, y += reference;
    xx += estimate * estimate, xy += estimate * reference, yy += reference * reference;
  }
  [[nodiscard]] Sums with(const Sums& other, double sign) const {
    return {n + sign * other.n,   x + sign * other.x,   y + sign * other.y,
            xx + sign * other.xx, xy + sign * other.xy, yy + sign * other.yy};
  }
};

struct ScaleLine {
  double scale, offset;
};

std::optional<ScaleLine> line_of(const Sums& sums) {
  if (sums.n < 2) return std::nullopt;
  const double x = sums.x / sums.n, y = sums.y / sums.n;
  const double xx = sums.xx / sums.n - x * x, yy = sums.yy / sums.n - y * y, xy = sums.xy / sums.n - x * y;
  if (!(xy > 0) || xx < least_variation * least_variation) return std::nullopt;
  const double scale = (yy - xx + std::hypot(yy - xx, 2 * xy)) / (2 * xy);
  return ScaleLine{scale, y - scale * x};
}

}  // namespace

std::optional<ReferenceScale> reference_scale(std::span<const float> estimate_m3_per_s,
                                              std::span<const float> reference_m3_per_s, double full_scale_m3_per_s) {
  const std::size_t samples = std::min(estimate_m3_per_s.size(), reference_m3_per_s.size());
  std::array<Sums, stretches> parts;
  for (std::size_t k = 0; k < samples; ++k) {
    const double x = estimate_m3_per_s[k] / full_scale_m3_per_s, y = reference_m3_per_s[k] / full_scale_m3_per_s;
    if (std::isfinite(x) && std::isfinite(y)) parts[k * stretches / samples].add(x, y);
  }
  Sums all;
  for (const Sums& part : parts) all = all.with(part, 1);
  const std::optional<ScaleLine> whole = line_of(all);
  if (!whole || all.n < least_samples) return std::nullopt;
  double count = 0, scale_squares = 0, offset_squares = 0;
  for (const Sums& part : parts) {
    if (part.n == 0) continue;
    const std::optional<ScaleLine> without = line_of(all.with(part, -1));
    if (!without) return std::nullopt;  // one stretch holds all
    scale_squares += std::pow(without->scale - whole->scale, 2);
    offset_squares += std::pow(without->offset - whole->offset, 2);
    ++count;
  }
  const double share = (count - 1) / count;
  return ReferenceScale{whole->scale, std::sqrt(share * scale_squares), whole->offset * full_scale_m3_per_s,
                        std::sqrt(share * offset_squares) * full_scale_m3_per_s};
}

}  // namespace spoolflow::validation
