#include "spoolflow/calibration/fits/both_directions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

/// Sums of a weighted straight-line fit around one grid point.
struct LocalLine {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0;
  int samples = 0;

  void add(double w, double dx, double value) {
    weight += w;
    x += w * dx;
    y += w * value;
    xx += w * dx * dx;
    xy += w * dx * value;
    ++samples;
  }
  /// The line's value at the grid point; NaN where too few samples surround it.
  [[nodiscard]] double at_centre(double distance_m) const {
    if (samples < 4 || weight <= 0) return std::nan("");
    const double mean_x = x / weight;
    const double variance = xx / weight - mean_x * mean_x;
    if (std::abs(mean_x) < 1e-9 * distance_m || variance < 1e-4 * distance_m * distance_m) return y / weight;
    return (y / weight) - mean_x * (xy / weight - mean_x * y / weight) / variance;
  }
};

/// One stroke by local lines over the grid; NaN where it has no samples.
std::vector<double> over_grid(const Sweep& sweep, const LevelSamples& samples, std::span<const double> grid_m) {
  const double distance_m = grid_m[1] - grid_m[0];
  std::vector<LocalLine> lines(grid_m.size());
  for (std::size_t k = sweep.begin; k < sweep.end; ++k) {
    const double position = samples.position_m[k];
    const double value = samples.value[k];
    if (std::isnan(position) || std::isnan(value)) continue;
    const auto nearest = static_cast<std::ptrdiff_t>(std::floor((position - grid_m[0]) / distance_m));
    for (std::ptrdiff_t g = nearest; g <= nearest + 1; ++g) {
      if (g < 0 || g >= static_cast<std::ptrdiff_t>(grid_m.size())) continue;
      const double dx = position - grid_m[static_cast<std::size_t>(g)];
      const double away = 1 - std::abs(dx) / distance_m;
      if (away > 0) lines[static_cast<std::size_t>(g)].add(away, dx, value);
    }
  }
  std::vector<double> values(grid_m.size());
  for (std::size_t g = 0; g < grid_m.size(); ++g) values[g] = lines[g].at_centre(distance_m);
  return values;
}

/// The straight line through the `count` values from `first` on, carried on to `at`; all are places in an even grid.
class LineThrough {
 public:
  LineThrough(std::span<const double> values, std::size_t first, std::size_t count) {
    const double middle = 0.5 * static_cast<double>(count - 1);
    centre_ = static_cast<double>(first) + middle;
    double moment = 0, spread = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double away = static_cast<double>(k) - middle;
      mean_ += values[first + k] / static_cast<double>(count);
      moment += away * values[first + k];
      spread += away * away;
    }
    slope_ = moment / spread;
  }
  [[nodiscard]] double at(std::size_t place) const { return mean_ + slope_ * (static_cast<double>(place) - centre_); }

 private:
  double mean_ = 0, slope_ = 0, centre_ = 0;
};

std::vector<double> average_strokes(Direction direction, const LevelSamples& samples, std::span<const double> grid_m,
                                    const std::string& what) {
  std::vector<double> sum(grid_m.size(), 0.0);
  std::vector<int> count(grid_m.size(), 0);
  for (const Sweep& sweep : samples.level.sweeps) {
    if (sweep.direction != direction) continue;
    const std::vector<double> stroke = over_grid(sweep, samples, grid_m);
    for (std::size_t g = 0; g < grid_m.size(); ++g) {
      if (std::isnan(stroke[g])) continue;
      sum[g] += stroke[g];
      ++count[g];
    }
  }
  const auto first =
      static_cast<std::size_t>(std::find_if(count.begin(), count.end(), [](int n) { return n > 0; }) - count.begin());
  const auto beyond =
      count.size() - static_cast<std::size_t>(std::find_if(count.rbegin(), count.rend(), [](int n) { return n > 0; }) -
                                              count.rbegin());
  const auto inner_gap =
      static_cast<std::size_t>(std::find(count.begin() + static_cast<std::ptrdiff_t>(std::min(first, beyond)),
                                         count.begin() + static_cast<std::ptrdiff_t>(beyond), 0) -
                               count.begin());
  const auto refuse = [&](double from_m, double to_m) {
    throw CalibrationError(
        fmt::format("{}: positions {:.3f} to {:.3f} mm are not covered by the {} strokes; record them over "
                    "the whole stroke",
                    what, 1e3 * from_m, 1e3 * to_m, direction == Direction::opening ? "opening" : "closing"));
  };
  if (first >= beyond) refuse(grid_m.front(), grid_m.back());
  if (inner_gap < beyond) refuse(grid_m[inner_gap], grid_m[inner_gap + 1]);
  if (first > 1) refuse(grid_m.front(), grid_m[first]);
  if (beyond + 1 < count.size()) refuse(grid_m[beyond - 1], grid_m.back());

  std::vector<double> mean(grid_m.size());
  for (std::size_t g = first; g < beyond; ++g) mean[g] = sum[g] / count[g];
  if (first == 1) mean[0] = 2 * mean[1] - mean[2];
  if (beyond + 1 == mean.size()) mean[beyond] = 2 * mean[beyond - 1] - mean[beyond - 2];
  return mean;
}

}  // namespace

std::vector<double> BothDirections::mean() const {
  std::vector<double> out(opening.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = 0.5 * (opening[k] + closing[k]);
  return out;
}

std::vector<double> BothDirections::half_width() const {
  std::vector<double> out(opening.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = 0.5 * (opening[k] - closing[k]);
  return out;
}

BothDirections average_both_directions(const LevelSamples& samples, std::span<const double> grid_m,
                                       const std::string& what) {
  return {{grid_m.begin(), grid_m.end()},
          average_strokes(Direction::opening, samples, grid_m, what),
          average_strokes(Direction::closing, samples, grid_m, what)};
}

BothDirections without_breakaway(BothDirections force, double wearing_m) {
  constexpr std::size_t line_positions = 3;  // more would not follow friction that rises towards the stroke's end
  const double distance_m = force.position_m[1] - force.position_m[0];
  const auto worn = static_cast<std::size_t>(wearing_m / distance_m) + 1;  // the first position beyond
  const std::size_t last = force.position_m.size() - 1;
  const std::vector<double> half_width = force.half_width();
  const LineThrough opened(half_width, worn, line_positions);
  const LineThrough closed(half_width, last - worn - line_positions + 1, line_positions);
  for (std::size_t k = 0; k < worn; ++k) {
    force.opening[k] = force.closing[k] + 2 * opened.at(k);
    force.closing[last - k] = force.opening[last - k] - 2 * closed.at(last - k);
  }
  return force;
}

}  // namespace spoolflow::calibration
