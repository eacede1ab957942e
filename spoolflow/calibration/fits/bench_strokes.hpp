#pragma once
/// What all quasi-static bench protocols share: strokes long enough to be averaged, and the oil they were made in.
#include <span>
#include <vector>

#include "spoolflow/calibration/fits/sweep.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// Strokes of at least a tenth of the valve's stroke, the first and last hundredth of it left out: friction turns over
/// within some ten micrometres after each reversal.
[[nodiscard]] std::vector<Sweep> find_bench_strokes(std::span<const double> position_m, double stroke_m);

/// Mean over the recording; NaN where the channel is absent.
[[nodiscard]] double mean_oil_temperature_K(const recording::Recording& recording);

}  // namespace spoolflow::calibration
