#pragma once
/// Zero drift and noise of the valve's position sensor, from where the bench finds the spool closed.
#include <optional>
#include <span>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

struct PositionSensorFit {
  double drift_m_per_K;                  ///< of the zero point
  double drift_free_K;                   ///< oil temperature at which the closed spool reads zero
  double drift_residual_m;               ///< of the closed positions about the line
  double noise_m;                        ///< standard deviation of one sample
  std::optional<model::Fit> known = {};  ///< of the drift's line; only from three temperatures on
};

/// Where a bench recording finds the spool closed: the median of what it reads within the hold at its lower end.
[[nodiscard]] double closed_reading_m(std::span<const double> position_m, double stroke_m);

/// Standard deviation of the noise of one sample: from second differences, robust against motion.
[[nodiscard]] double noise_of(std::span<const double> position_m);

/// From recordings at different oil temperatures; with less than 10 K between them the drift is taken as zero.
[[nodiscard]] PositionSensorFit fit_position_sensor(const std::vector<const recording::Recording*>& recordings,
                                                    double stroke_m);

/// The recording with its positions lowered by `offset_m`.
[[nodiscard]] recording::Recording shifted(recording::Recording recording, double offset_m);

/// The recording with its positions shifted so that the closed spool reads zero.
[[nodiscard]] recording::Recording without_zero_offset(recording::Recording recording, double stroke_m);

}  // namespace spoolflow::calibration
