#include "spoolflow/calibration/fits/magnetic_force_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/fits/both_directions.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
constexpr std::size_t least_currents = 4;

struct PositionRange {
  double lowest_m;
  double highest_m;
};

/// The positions that every level's strokes reach, with what the strokes' ends lost.
PositionRange common_range(const std::vector<Level>& levels, std::span<const double> position_m, double stroke_m) {
  PositionRange range{-1e9, 1e9};
  for (const Level& level : levels) {
    double lowest = 1e9;
    double highest = -1e9;
    for (const Sweep& sweep : level.sweeps) {
      for (std::size_t k = sweep.begin; k < sweep.end; ++k) {
        if (position_m[k] < lowest) lowest = position_m[k];
        if (position_m[k] > highest) highest = position_m[k];
      }
    }
    range.lowest_m = std::max(range.lowest_m, lowest);
    range.highest_m = std::min(range.highest_m, highest);
  }
  // Strokes lose a hundredth at either end; a map that ends that little inside the valve's stroke is stretched to it.
  const double lost_m = 0.015 * stroke_m;
  return {range.lowest_m - lost_m < 0 ? std::min(0.0, range.lowest_m) : range.lowest_m,
          range.highest_m + lost_m > stroke_m ? std::max(stroke_m, range.highest_m) : range.highest_m};
}

double mean_over(const Level& level, std::span<const double> values) {
  double sum = 0;
  double count = 0;
  for (const Sweep& sweep : level.sweeps) {
    for (std::size_t k = sweep.begin; k < sweep.end; ++k) {
      if (std::isnan(values[k])) continue;
      sum += values[k];
      count += 1;
    }
  }
  return sum / count;
}

/// Column by column across the held currents onto the sensor's equally spaced currents.
void fill_map(MagneticForceFit& fit, const std::vector<BothDirections>& forces, const std::vector<double>& currents_A) {
  sensor::Map<double, sensor::force_map_currents, sensor::force_map_positions>& map = fit.magnetic_force.map;
  const std::vector<double> rows_A = equally_spaced(0, fit.largest_current_A, sensor::force_map_currents);
  std::vector<double> known_A(currents_A);
  const bool measured_at_zero = known_A.front() < 0.01 * known_A.back();
  if (!measured_at_zero) known_A.insert(known_A.begin(), 0.0);
  std::vector<double> widest(known_A.size(), 0.0);
  for (int column = 0; column < sensor::force_map_positions; ++column) {
    std::vector<double> known_N;
    if (!measured_at_zero) known_N.push_back(0.0);
    for (const BothDirections& force : forces) {
      const auto c = static_cast<std::size_t>(column);
      known_N.push_back(0.5 * (force.opening[c] + force.closing[c]));
      const std::size_t level = known_N.size() - 1;
      widest[level] = std::max(widest[level], 0.5 * std::abs(force.opening[c] - force.closing[c]));
    }
    const std::vector<double> rows_N = interpolate_monotone({known_A, known_N}, rows_A);
    for (int row = 0; row < sensor::force_map_currents; ++row)
      map.node(row, column) = rows_N[static_cast<std::size_t>(row)];
  }
  const std::vector<double> rows_half_width_N = interpolate_monotone({known_A, widest}, rows_A);
  std::copy(rows_half_width_N.begin(), rows_half_width_N.end(),
            fit.magnetic_force.hysteresis_half_width_N.values.begin());
}

}  // namespace

MagneticForceFit fit_magnetic_force(const recording::Recording& recording, double stroke_m) {
  const std::string file = recording.file.filename().string();
  const auto position_m = recording[Channel::position];
  const auto current_A = recording[Channel::current];
  const auto force_N = recording[Channel::force];
  const HeldQuantity quantity{"coil current", "A", 1.0};
  const auto held = recording.has(Channel::current_set) ? recording[Channel::current_set] : current_A;
  const std::vector<Level> levels = sort_by_level(find_bench_strokes(position_m, stroke_m), held);
  require_levels(levels, least_currents, quantity, file);

  MagneticForceFit fit{};
  const PositionRange range = common_range(levels, position_m, stroke_m);
  if (range.lowest_m > 0.05 * stroke_m || range.highest_m < 0.95 * stroke_m) {
    throw CalibrationError(
        fmt::format("{}: strokes at all currents reach positions {:.3f} to {:.3f} mm only, the valve's stroke is 0 to "
                    "{:.3f} mm; record "
                    "the whole stroke at every current",
                    file, 1e3 * range.lowest_m, 1e3 * range.highest_m, 1e3 * stroke_m));
  }
  const std::vector<double> grid_m = equally_spaced(range.lowest_m, range.highest_m, sensor::force_map_positions);

  std::vector<BothDirections> forces;
  std::vector<double> currents_A;
  for (const Level& level : levels) {
    forces.push_back(
        average_both_directions({level, position_m, force_N}, grid_m,
                                fmt::format("{}: {} {}", file, quantity.name, quantity.written(level.value))));
    currents_A.push_back(mean_over(level, current_A));
    fit.loops.push_back({currents_A.back(), grid_m, forces.back().opening, forces.back().closing});
  }
  fit.largest_current_A = currents_A.back();
  const double step_m = grid_m[1] - grid_m[0];
  const double step_A = fit.largest_current_A / (sensor::force_map_currents - 1);
  fit.magnetic_force.map.row_axis = {0, step_A, 1 / step_A};
  fit.magnetic_force.map.column_axis = {range.lowest_m, step_m, 1 / step_m};
  fit.magnetic_force.hysteresis_half_width_N.axis = fit.magnetic_force.map.row_axis;
  fill_map(fit, forces, currents_A);

  for (std::size_t l = 0; l < levels.size(); ++l) {
    sensor::Curve<double, sensor::force_map_positions> half_width{fit.magnetic_force.map.column_axis, {}};
    const std::vector<double> values = forces[l].half_width();
    std::copy(values.begin(), values.end(), half_width.values.begin());
    for (const Sweep& sweep : levels[l].sweeps) {
      const double sign = sweep.direction == Direction::opening ? 1 : -1;
      for (std::size_t k = sweep.begin; k < sweep.end; ++k) {
        fit.residual.add(force_N[k] - fit.magnetic_force.at(current_A[k], position_m[k]).value -
                         sign * half_width.at(position_m[k]).value);
      }
    }
  }
  return fit;
}

}  // namespace spoolflow::calibration
