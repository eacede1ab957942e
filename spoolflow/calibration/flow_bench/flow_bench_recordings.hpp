#pragma once
/// What a fit of the flow bench is made from.
#include <vector>

#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// The recordings of one direction made by the valve's own solenoid.
struct FlowBenchRecordings {
  std::vector<const recording::Recording*> unpressurised;
  std::vector<const recording::Recording*> metering;
  std::vector<const recording::Recording*> operation;
};

/// What force benches measured of the same valve; null where they did not.
struct MeasuredForces {
  const ActuatorFit* actuator = nullptr;
  const SpringFit* spring = nullptr;
};

}  // namespace spoolflow::calibration
