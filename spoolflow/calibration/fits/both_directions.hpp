#pragma once
/// Removes hysteresis by averaging the strokes of both directions at the same position (paper section 3).
#include <span>
#include <string>
#include <vector>

#include "spoolflow/calibration/fits/level.hpp"

namespace spoolflow::calibration {

/// A quantity over position, for each direction of motion by itself.
struct BothDirections {
  std::vector<double> position_m;
  std::vector<double> opening;
  std::vector<double> closing;

  /// Averaged over both directions: what friction and hysteresis, equal and opposite in both, leave.
  [[nodiscard]] std::vector<double> mean() const;
  /// Half the distance of both directions, signed: > 0 where opening lies above closing.
  [[nodiscard]] std::vector<double> half_width() const;
};

/// The samples of one recording that are averaged together.
struct LevelSamples {
  const Level& level;
  std::span<const double> position_m;
  std::span<const double> value;
};

/// Averages `value` over all strokes of a level at each of `grid_m` (rising, equally spaced). Each stroke is fitted by
/// a local line around the grid point, so neither the speed of a stroke nor the noise of its position shifts the
/// result, and each stroke counts the same. Throws CalibrationError naming `what` and the positions that no stroke
/// covers; the ends may be extrapolated by one grid distance.
[[nodiscard]] BothDirections average_both_directions(const LevelSamples& samples, std::span<const double> grid_m,
                                                     const std::string& what);

/// Of a force in which friction is what differs between both directions. A stroke begins from rest, and what its
/// friction has grown by there wears off over some ten micrometres of sliding. As far as `wearing_m` from where each
/// direction begins, the other direction, which comes sliding, gives the force, and friction follows the straight line
/// through the next positions. Positions as `average_both_directions` has them.
[[nodiscard]] BothDirections without_breakaway(BothDirections force, double wearing_m);

}  // namespace spoolflow::calibration
