#include "spoolflow/calibration/fits/level.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

struct HeldStroke {
  double value;   ///< median of the held quantity
  double spread;  ///< distance of its medians over the first and last quarter
  Sweep sweep;
};

double median(std::span<const double> values) {
  return numerics::median({values.begin(), values.end()});
}

HeldStroke held_during(const Sweep& sweep, std::span<const double> held) {
  const std::span<const double> all = held.subspan(sweep.begin, sweep.end - sweep.begin);
  const std::size_t quarter = std::max<std::size_t>(1, all.size() / 4);
  return {median(all), std::abs(median(all.last(quarter)) - median(all.first(quarter))), sweep};
}

}  // namespace

std::string HeldQuantity::written(double value_SI) const {
  return fmt::format("{:.4g} {}", value_SI * unit_per_SI, unit);
}

std::vector<Level> sort_by_level(const std::vector<Sweep>& sweeps, std::span<const double> held) {
  std::vector<HeldStroke> strokes;
  for (const Sweep& sweep : sweeps) {
    const HeldStroke stroke = held_during(sweep, held);
    if (!std::isnan(stroke.value)) strokes.push_back(stroke);
  }
  if (strokes.empty()) return {};
  std::sort(strokes.begin(), strokes.end(), [](const HeldStroke& a, const HeldStroke& b) { return a.value < b.value; });

  // Strokes whose held values differ by less than this are the same level: a fiftieth of the range covers the noise of
  // a controlled pressure, while levels that people choose lie further apart.
  const double same_level =
      0.02 * (strokes.back().value - strokes.front().value) + 1e-3 * std::abs(strokes.back().value);
  std::erase_if(strokes, [&](const HeldStroke& stroke) { return stroke.spread > std::max(same_level, 1e-12); });
  std::vector<Level> levels;
  std::vector<double> sums;
  for (const HeldStroke& stroke : strokes) {
    if (levels.empty() || stroke.value - sums.back() / static_cast<double>(levels.back().sweeps.size()) > same_level) {
      levels.push_back({stroke.value, {}});
      sums.push_back(0);
    }
    levels.back().sweeps.push_back(stroke.sweep);
    sums.back() += stroke.value;
    levels.back().value = sums.back() / static_cast<double>(levels.back().sweeps.size());
  }
  return levels;
}

void require_both_directions(const Level& level, const std::string& what) {
  for (const Direction direction : {Direction::opening, Direction::closing}) {
    if (std::none_of(level.sweeps.begin(), level.sweeps.end(),
                     [&](const Sweep& sweep) { return sweep.direction == direction; })) {
      throw CalibrationError(fmt::format(
          "{}: there is no {} stroke, and averaging needs both directions; hold it over whole strokes to and fro", what,
          direction == Direction::opening ? "opening" : "closing"));
    }
  }
}

void require_levels(const std::vector<Level>& levels, std::size_t least_levels, const HeldQuantity& quantity,
                    const std::string& file) {
  if (levels.size() < least_levels) {
    std::string found;
    for (const Level& level : levels) found += (found.empty() ? "" : ", ") + quantity.written(level.value);
    throw CalibrationError(
        fmt::format("{}: strokes at {} held levels of {} ({}), a map needs at least {}; record to-and-fro "
                    "strokes at more levels",
                    file, levels.size(), quantity.name, found.empty() ? "none" : found, least_levels));
  }
  for (const Level& level : levels) {
    require_both_directions(level, fmt::format("{}: {} {}", file, quantity.name, quantity.written(level.value)));
  }
  for (std::size_t k = 1; k + 2 < levels.size(); ++k) {
    const double before = levels[k].value - levels[k - 1].value;
    const double here = levels[k + 1].value - levels[k].value;
    const double after = levels[k + 2].value - levels[k + 1].value;
    if (std::abs(after / before - 1) < 0.2 && here > 1.8 * std::max(before, after)) {
      throw CalibrationError(fmt::format(
          "{}: a level of {} is absent between {} and {}, where the levels around are {} apart; record it to and fro",
          file, quantity.name, quantity.written(levels[k].value), quantity.written(levels[k + 1].value),
          quantity.written(before)));
    }
  }
}

}  // namespace spoolflow::calibration
