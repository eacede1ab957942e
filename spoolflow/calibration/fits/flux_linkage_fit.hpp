#pragma once
/// Flux linkage over magnetising current and position from the coil voltage of the solenoid's bench recordings.
#include <span>

#include "spoolflow/calibration/fits/flux_evidence.hpp"
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/coil_resistance.hpp"

namespace spoolflow::calibration {

struct FluxLinkageFit {
  sensor::FluxLinkage<double> flux_linkage;
  bool measured;  ///< false: there was no voltage; shaped after the force, 1 Wb/A on average
  sensor::CoilResistance<double> coil_resistance;  ///< all zero where not measured
  FitResidual residual;                            ///< of flux changes over short windows [Wb]
  model::Fit known;                                ///< empty where not measured
  double misfit;                                   ///< its mean square in units of the variance that noise explains
};

/// Linear least squares on flux changes over short windows: u = R i + d flux/dt, the resistance drifting slowly with
/// the coil's temperature. Where no recording has a voltage, the flux is taken in proportion to the root of the force
/// (Maxwell's pull), which is enough to drive the hysteresis but not to read a voltage.
[[nodiscard]] FluxLinkageFit fit_flux_linkage(std::span<const FluxEvidence> evidence,
                                              const sensor::MagneticForce<double>& magnetic_force);

}  // namespace spoolflow::calibration
