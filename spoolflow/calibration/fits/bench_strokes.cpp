#include "spoolflow/calibration/fits/bench_strokes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {

std::vector<Sweep> find_bench_strokes(std::span<const double> position_m, double stroke_m) {
  return find_sweeps(position_m, 0.1 * stroke_m, 0.01 * stroke_m);
}

void require_both_directions(const Level& level, const std::string& what) {
  for (const Direction direction : {Direction::opening, Direction::closing}) {
    if (std::none_of(level.sweeps.begin(), level.sweeps.end(),
                     [&](const Sweep& sweep) { return sweep.direction == direction; })) {
      throw CalibrationError(
          fmt::format("{}: there is no {} stroke, and averaging needs both directions; record it to and fro", what,
                      direction == Direction::opening ? "opening" : "closing"));
    }
  }
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
