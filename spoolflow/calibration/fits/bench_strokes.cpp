#include "spoolflow/calibration/fits/bench_strokes.hpp"

#include <cmath>

namespace spoolflow::calibration {

namespace {

/// Extremes from which the position has since come back by `least_travel_m`, with the ends of the recording.
std::vector<std::size_t> turning_points(std::span<const double> position_m, double least_travel_m) {
  std::vector<std::size_t> turns;
  std::size_t lowest = 0;
  std::size_t highest = 0;
  int heading = 0;  // +1 opening, -1 closing, 0 not yet known
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double x = position_m[k];
    if (std::isnan(x)) continue;
    if (!(x >= position_m[lowest])) lowest = k;
    if (!(x <= position_m[highest])) highest = k;
    if (heading <= 0 && x - position_m[lowest] >= least_travel_m) {
      turns.push_back(lowest);
      heading = 1;
      highest = k;
    } else if (heading >= 0 && position_m[highest] - x >= least_travel_m) {
      turns.push_back(highest);
      heading = -1;
      lowest = k;
    }
  }
  if (heading != 0) turns.push_back(heading > 0 ? highest : lowest);
  return turns;
}

}  // namespace

std::vector<Sweep> find_sweeps(std::span<const double> position_m, double least_travel_m, double settling_m) {
  const std::vector<std::size_t> turns = turning_points(position_m, least_travel_m);
  const auto near = [&](std::size_t k, std::size_t turn) {
    return !(std::abs(position_m[k] - position_m[turn]) > settling_m);
  };
  std::vector<Sweep> sweeps;
  for (std::size_t k = 0; k + 1 < turns.size(); ++k) {
    Sweep sweep{position_m[turns[k + 1]] > position_m[turns[k]] ? Direction::opening : Direction::closing, turns[k],
                turns[k + 1] + 1};
    while (sweep.begin < sweep.end && near(sweep.begin, turns[k])) ++sweep.begin;
    while (sweep.end > sweep.begin && near(sweep.end - 1, turns[k + 1])) --sweep.end;
    if (sweep.end > sweep.begin) sweeps.push_back(sweep);
  }
  return sweeps;
}

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
