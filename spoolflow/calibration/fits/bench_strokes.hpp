#pragma once
/// What all quasi-static bench protocols share: strokes long enough to be averaged, and the oil they were made in.
#include <cstddef>
#include <span>
#include <vector>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

enum class Direction { opening, closing };

/// A stroke of a bench recording: samples [begin, end) that travel one way, without the holds at their ends.
struct Sweep {
  Direction direction;
  std::size_t begin;
  std::size_t end;
};

/// Strokes that travel at least `least_travel_m`. Noise and jitter smaller than that do not end a stroke; a hold at an
/// end belongs to none. The first `settling_m` of each stroke, where friction still turns over, is left out as well.
[[nodiscard]] std::vector<Sweep> find_sweeps(std::span<const double> position_m, double least_travel_m,
                                             double settling_m);

/// Strokes of at least a tenth of the valve's stroke, the first and last hundredth of it left out: friction turns over
/// within some ten micrometres after each reversal.
[[nodiscard]] std::vector<Sweep> find_bench_strokes(std::span<const double> position_m, double stroke_m);

/// What a stroke's friction has grown by at rest has worn off within so much of the valve's stroke: some 0.1 mm, where
/// films renew over some ten micrometres of sliding.
inline constexpr double wearing_stroke_share = 0.05;

/// The stroke from there on.
[[nodiscard]] Sweep sliding_part(Sweep sweep, std::span<const double> position_m, double stroke_m);

/// Mean over the recording; NaN where the channel is absent.
[[nodiscard]] double mean_oil_temperature_K(const recording::Recording& recording);

}  // namespace spoolflow::calibration
