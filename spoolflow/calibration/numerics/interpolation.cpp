#include "spoolflow/calibration/numerics/interpolation.hpp"

#include <algorithm>
#include <math.h>  // NOLINT: Boost 1.74's pchip uses the global names

#include <boost/math/interpolators/pchip.hpp>

namespace spoolflow::calibration {
namespace {

double linear(const Samples1D& points, double x) {
  const auto above = static_cast<std::size_t>(std::upper_bound(points.x.begin(), points.x.end(), x) - points.x.begin());
  if (above == 0) return points.y.front();
  if (above == points.x.size()) return points.y.back();
  const double share = (x - points.x[above - 1]) / (points.x[above] - points.x[above - 1]);
  return points.y[above - 1] + share * (points.y[above] - points.y[above - 1]);
}

}  // namespace

std::vector<double> interpolate_monotone(const Samples1D& points, std::span<const double> at) {
  std::vector<double> out;
  out.reserve(at.size());
  if (points.x.size() < 4) {
    for (const double x : at) out.push_back(linear(points, x));
    return out;
  }
  const boost::math::interpolators::pchip<std::vector<double>> cubic(
      std::vector<double>(points.x.begin(), points.x.end()), std::vector<double>(points.y.begin(), points.y.end()));
  for (const double x : at) out.push_back(cubic(std::clamp(x, points.x.front(), points.x.back())));
  return out;
}

std::vector<double> non_decreasing(std::span<const double> values) {
  struct Pool {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const double value : values) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::vector<double> out;
  for (const Pool& pool : pools) out.insert(out.end(), pool.count, pool.mean());
  return out;
}

std::vector<double> equally_spaced(double first, double last, int count) {
  std::vector<double> out(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) out[static_cast<std::size_t>(k)] = first + (last - first) * k / (count - 1);
  return out;
}

}  // namespace spoolflow::calibration
