#pragma once
/// How wrong an estimate is against a reference flow, by phases of the motion.
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace spoolflow::validation {

/// Figures of a set of errors; in the unit of the errors. `p95` is the 95th percentile of the magnitudes.
struct ErrorFigures {
  double p95 = 0;
  double rms = 0;
  double largest = 0;
  double bias = 0;
  std::size_t samples = 0;
};

/// Sorts `errors`. No samples: all zero.
[[nodiscard]] ErrorFigures error_figures(std::vector<double> errors);

/// Which samples move (faster than 1 % of the stroke a second), rest (not moving, more than 1 % open), or stand within
/// 2 s of a reversal or a stop of the motion. A sample may belong to none.
struct Phases {
  std::vector<bool> moving;
  std::vector<bool> rest;
  std::vector<bool> reversal;
  bool from_measured_position = false;  ///< no position_set was recorded
};

/// From the commanded position as a share of the stroke.
[[nodiscard]] Phases phases_of_command(std::span<const double> time_s, std::span<const double> position_set);
/// From the measured position, smoothed over 0.2 s.
[[nodiscard]] Phases phases_of_position(std::span<const double> time_s, std::span<const double> position_m,
                                        double stroke_m);

/// An estimate beside its reference, sample by sample; equally long, SI.
struct Comparison {
  std::span<const double> estimate_m3_per_s;
  std::span<const double> lower_m3_per_s;
  std::span<const double> upper_m3_per_s;
  std::span<const double> reference_m3_per_s;  ///< NaN where there is none
};

struct Metrics {
  ErrorFigures all, moving, rest, reversal;  ///< m3/s
  ErrorFigures share_of_reading;  ///< error over reference, where the reference is above a tenth of full scale
  double band_coverage = 0;       ///< share of samples inside the 95 % band
  double band_mean_width_m3_per_s = 0;
};

[[nodiscard]] Metrics compare(const Comparison& comparison, const Phases& phases, double full_scale_m3_per_s);

/// A first-order lag, as the reference meter has it, applied to an estimate.
[[nodiscard]] std::vector<double> lagged(std::span<const double> time_s, std::span<const double> values, double lag_s);

}  // namespace spoolflow::validation
