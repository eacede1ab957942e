#pragma once
/// Identifies the sensor's hysteresis from known flux and output: loops of a material, or a coil whose flux is known.
#include <span>
#include <vector>

#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/sensor/magnetic_hysteresis.hpp"

namespace spoolflow::calibration {

/// One history of flux from the demagnetised state on, and what was measured along it.
struct HysteresisHistory {
  std::vector<double> flux;
  std::vector<double> output;                   ///< what hysteresis and the companions together make
  std::vector<double> weight;                   ///< 1 / standard deviation of the output; 0 only moves the memory
  std::vector<std::vector<double>> companions;  ///< what else the output may hold, each with an unknown share >= 0
};

struct HysteresisFit {
  sensor::MagneticHysteresis<double> hysteresis;
  std::vector<double> companion_shares;
  FitResidual residual;  ///< weighted
};

/// Non-negative least squares on stiffnesses and companions' shares. The thresholds are spaced geometrically; of a few
/// spacings the one that leaves least is kept.
[[nodiscard]] HysteresisFit fit_hysteresis(std::span<const HysteresisHistory> histories);

}  // namespace spoolflow::calibration
