#pragma once
/// What force benches would have recorded of a valve that only a flow bench has seen: the fitted forces as strokes of
/// the protocols `spring`, `solenoid_force_map` and `axial_force_map`, so that every fit downstream is the same.
#include <deque>
#include <string>
#include <vector>

#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/flow_bench/flow_bench_recordings.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

struct EquivalentBenches {
  recording::Recording spring;
  recording::Recording solenoid_force_map;
  std::deque<recording::Recording> axial_force_maps;   ///< one a recording of `metering`, then of further oil
  std::deque<recording::Recording> outlet_force_maps;  ///< of the outlet, where edges were metered one at a time
  ActuatorFit actuator;
  PositionSensorFit position;     ///< of the valve's own sensor
  double force_residual_N;        ///< RMS of what the forces leave of the sliding samples
  double flow_residual_m3_per_s;  ///< RMS of what conductances leave of the flow meter
  double largest_voltage_V;       ///< of the coil, either way; 0 where none was recorded
  std::vector<model::Fit> known;  ///< what the fit knows of its unknowns
  bool actuator_was_measured, spring_was_measured, axial_force_was_measured;  ///< by force rigs, and these hold it
  double force_scale_95;  ///< by what share all forces may be wrong in proportion, half width
};

/// The share of a jet's force that its angle leaves open: von Mises' 69 degrees within 3.
inline constexpr double jet_force_95 = 0.14;

/// Flow force over that of a jet at 69 degrees; NaN where a force rig gives the scale, or nothing was metered.
[[nodiscard]] double force_over_jet(const EquivalentBenches& benches);

/// A sentence where the coil's coenergy gives a flow force that is not 0.62 to 1.6 times that of the jet; else, and of
/// NaN, empty.
[[nodiscard]] std::string doubtful_scale(double share);

/// Forces and flow are as uncertain as the flow bench, in place of force benches, leaves them.
void widen(std::vector<model::Residual>& residuals, const EquivalentBenches& flow_bench);

/// Throws CalibrationError as fit_flow_bench and fit_conductance do.
[[nodiscard]] EquivalentBenches equivalent_benches(const FlowBenchRecordings& recordings,
                                                   const MeasuredForces& measured, double stroke_m);

}  // namespace spoolflow::calibration
