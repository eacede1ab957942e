#pragma once
/// What a fit of the flow bench is made from.
#include <optional>
#include <vector>

#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// The recordings of one direction made by the valve's own solenoid.
struct FlowBenchRecordings {
  std::vector<const recording::Recording*> unpressurised;
  std::vector<const recording::Recording*> metering;  ///< of all edges that the oil passes; or of the inlet alone
  std::vector<const recording::Recording*> operation;
  std::vector<const recording::Recording*> metering_outlet{};  ///< of the outlet alone; empty where both are joined

  [[nodiscard]] bool one_edge_at_a_time() const { return !metering_outlet.empty(); }
  /// Strokes under pressure, of whichever edges.
  [[nodiscard]] std::vector<const recording::Recording*> all_metering() const {
    std::vector<const recording::Recording*> out = metering;
    out.insert(out.end(), metering_outlet.begin(), metering_outlet.end());
    return out;
  }
};

/// What force benches measured of the same valve, empty where they did not; positions free of drift.
struct MeasuredForces {
  std::optional<ActuatorFit> actuator;
  std::optional<SpringFit> spring;
  std::vector<AxialForceFit> axial;  ///< of both edges of the path together
};

}  // namespace spoolflow::calibration
