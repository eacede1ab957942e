#pragma once
/// Calibration of the full sensor from a campaign.
#include <functional>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

struct ObserverRecordings {
  const recording::Recording& spring;
  const recording::Recording& solenoid_force_map;
  std::vector<const recording::Recording*> solenoid_dynamic;  ///< none or one
  std::vector<const recording::Recording*> axial_force_maps;  ///< one an oil temperature
  std::vector<const recording::Recording*> operation;  ///< none, or runs with pressure difference or flow reference
};

struct ObserverCalibration {
  model::Observer observer;
  model::BenchResiduals bench;
};

/// Bench maps free of position drift, then what only operation shows; what no recording shows is assumed, and said so
/// in `defaults`. `closed_below_m` is the condensed model's; `progress` is told the share done. Throws
/// CalibrationError.
[[nodiscard]] ObserverCalibration calibrate_observer(const ObserverRecordings& recordings, const model::Valve& valve,
                                                     double closed_below_m,
                                                     const std::function<void(double)>& progress);

}  // namespace spoolflow::calibration
