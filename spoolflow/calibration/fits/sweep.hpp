#pragma once
/// Finds the strokes of a bench recording: stretches in which the position travels one way.
#include <cstddef>
#include <span>
#include <vector>

namespace spoolflow::calibration {

enum class Direction { opening, closing };

/// Samples [begin, end) that travel one way, without the holds at their ends.
struct Sweep {
  Direction direction;
  std::size_t begin;
  std::size_t end;
};

/// Strokes that travel at least `least_travel_m`. Noise and jitter smaller than that do not end a stroke; a hold at an
/// end belongs to none. The first `settling_m` of each stroke, where friction still turns over, is left out as well.
[[nodiscard]] std::vector<Sweep> find_sweeps(std::span<const double> position_m, double least_travel_m,
                                             double settling_m);

}  // namespace spoolflow::calibration
