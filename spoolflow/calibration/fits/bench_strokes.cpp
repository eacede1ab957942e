#include "spoolflow/calibration/fits/bench_strokes.hpp"

#include <cmath>

namespace spoolflow::calibration {

std::vector<Sweep> find_bench_strokes(std::span<const double> position_m, double stroke_m) {
  return find_sweeps(position_m, 0.1 * stroke_m, 0.01 * stroke_m);
}

Sweep sliding_part(Sweep sweep, std::span<const double> position_m, double stroke_m) {
  const double from_m = position_m[sweep.begin];
  while (sweep.begin + 1 < sweep.end && !(std::abs(position_m[sweep.begin] - from_m) > wearing_stroke_share * stroke_m))
    ++sweep.begin;
  return sweep;
}

double mean_oil_temperature_K(const recording::Recording& recording) {
  if (!recording.has(recording::Channel::oil_temperature)) return std::nan("");
  double sum = 0;
  std::size_t count = 0;
  for (const double temperature_K : recording[recording::Channel::oil_temperature]) {
    if (std::isnan(temperature_K)) continue;
    sum += temperature_K;
    ++count;
  }
  return count == 0 ? std::nan("") : sum / static_cast<double>(count);
}

}  // namespace spoolflow::calibration
