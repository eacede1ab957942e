#pragma once
/// All forces of a valve from its flow bench alone: current, voltage, position, oil temperature, pressure difference.
/// The coil's voltage gives the flux linkage, its coenergy the size and the shape of the magnetic force
/// (coenergy.hpp); samples in which the spool slides evenly give the coil, all those of its passages the other forces
/// (force_equations.hpp).
#include "spoolflow/calibration/flow_bench/flow_bench_recordings.hpp"
#include "spoolflow/calibration/flow_bench/force_equations.hpp"

namespace spoolflow::calibration {

/// Oil temperatures that are no further apart are one.
inline constexpr double same_oil_K = 3;

/// By what share coenergy was found wrong on valves of the rig at most. Without a force rig the fit keeps its scale.
inline constexpr double coenergy_scale_95 = 0.3;

struct FlowBenchFit {
  ForceLayout layout;
  ForceSolution forces;
  FluxLinkageFit flux_linkage;
  sensor::Coil<double> coil;
  sensor::MagneticForce<double> magnetic_force;  ///< over magnetising current
  CoilSizes coil_sizes{};
};

/// What was measured stays as it was, and narrows the rest. Throws CalibrationError where no recording has a voltage
/// and no force map gives the magnetic force, or where the spool slides too little.
[[nodiscard]] FlowBenchFit fit_flow_bench(const FlowBenchRecordings& recordings, const MeasuredForces& measured,
                                          double stroke_m);

}  // namespace spoolflow::calibration
