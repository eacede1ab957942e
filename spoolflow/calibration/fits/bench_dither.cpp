#include "spoolflow/calibration/fits/bench_dither.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/zero_phase_filter.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

/// Each missing value as the one before.
std::vector<double> without_gaps(std::vector<double> values) {
  const auto known = std::ranges::find_if(values, [](double v) { return std::isfinite(v); });
  double last = known == values.end() ? 0.0 : *known;
  for (double& value : values) {
    if (!std::isfinite(value)) value = last;
    last = value;
  }
  return values;
}

double usual_step_s(const recording::Recording& recording) {
  const auto time_s = recording[Channel::time];
  std::vector<double> steps_s;
  for (std::size_t k = 1; k < time_s.size(); ++k) steps_s.push_back(time_s[k] - time_s[k - 1]);
  return steps_s.empty() ? 0.0 : numerics::median(steps_s);
}

}  // namespace

bool is_dithered(const recording::Recording& recording, double least_step_s) {
  constexpr std::size_t neighbours = 3;  // to either side
  constexpr double far_s = 10e-3;        // or so far, whatever is further
  const auto time_s = recording[Channel::time];
  const std::vector<double> current_A = without_gaps(recording.column(Channel::current));
  std::vector<double> aside_A;
  double largest_A = 0;
  for (std::size_t k = 1; k < current_A.size(); ++k) {
    largest_A = std::max(largest_A, std::abs(current_A[k]));
    const double step_s = time_s[k] - time_s[k - 1];
    if (!(step_s >= least_step_s) || !(step_s > 0)) continue;
    const std::size_t reach = std::max(neighbours, static_cast<std::size_t>(far_s / step_s));
    if (k < reach || k + reach >= current_A.size()) continue;
    double sum_A = 0;
    for (std::size_t n = 1; n <= reach; ++n) sum_A += current_A[k - n] + current_A[k + n];
    aside_A.push_back(std::abs(current_A[k] - sum_A / static_cast<double>(2 * reach)));
  }
  return !aside_A.empty() && numerics::median(aside_A) > dithered_share * largest_A;
}

recording::Recording without_dither(const recording::Recording& force_map) {
  if (!is_dithered(force_map, 0)) return force_map;
  recording::Recording out = force_map;
  const double step_s = usual_step_s(force_map);
  for (const Channel channel : {Channel::current_set, Channel::current, Channel::voltage, Channel::force}) {
    if (!force_map.has(channel)) continue;
    const std::vector<double> whole = without_gaps(force_map.column(channel));
    out.column(channel) = zero_phase_low_pass({whole, step_s}, dithered_map_bandwidth_Hz);
  }
  return out;
}

void require_resolved_dither(const recording::Recording& solenoid_dynamic) {
  if (!is_dithered(solenoid_dynamic, resolving_step_s)) return;
  throw CalibrationError(fmt::format(
      "{}: the coil current is dithered in tests recorded every {:.1f} ms or slower, which does not resolve "
      "it; record solenoid_dynamic without dither, or all of it at 5 kHz",
      solenoid_dynamic.file.filename().string(), 1e3 * resolving_step_s));
}

}  // namespace spoolflow::calibration
