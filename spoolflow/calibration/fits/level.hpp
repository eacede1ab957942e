#pragma once
/// Sorts strokes by the quantity that was held during each, such as coil current or pressure difference.
#include <string>
#include <vector>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// Strokes at one held value.
struct Level {
  double value;  ///< SI unit of the held channel
  std::vector<Sweep> sweeps;
};

/// How a held quantity is named in messages: {"current", "A", 1} or {"pressure difference", "bar", 1e-5}.
struct HeldQuantity {
  std::string name;
  std::string unit;
  double unit_per_SI;

  [[nodiscard]] std::string written(double value_SI) const;
};

/// Levels in rising order, whatever their order in the recording. Strokes during which the held value itself travelled
/// by more than a quarter of the smallest level distance are left out.
[[nodiscard]] std::vector<Level> sort_by_level(const std::vector<Sweep>& sweeps, std::span<const double> held);

/// Throws CalibrationError unless the level has strokes both ways.
void require_both_directions(const Level& level, const std::string& what);

/// Throws CalibrationError unless there are `least_levels`, each with both directions, and no level is left out of an
/// otherwise even row of levels.
void require_levels(const std::vector<Level>& levels, std::size_t least_levels, const HeldQuantity& quantity,
                    const std::string& file);

}  // namespace spoolflow::calibration
