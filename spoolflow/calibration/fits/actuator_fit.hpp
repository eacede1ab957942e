#pragma once
/// The solenoid's whole calibration: flux linkage, hysteresis, eddy currents, armature friction, uncertainty.
#include <optional>
#include <vector>

#include "spoolflow/calibration/fits/armature_friction.hpp"
#include "spoolflow/calibration/fits/flux_linkage_fit.hpp"
#include "spoolflow/calibration/fits/magnetic_force_fit.hpp"
#include "spoolflow/calibration/fits/solenoid_dynamics.hpp"
#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/sensor/actuator.hpp"

namespace spoolflow::calibration {

/// Sets how unsure the actuator is of its force, so that the squares of its deviations from the load cell are
/// explained: a constant, a part with the force's slope over current, and a part with the eddy current. `actuator` is
/// otherwise complete; the armature is held during the recording.
void fit_uncertainty(sensor::ActuatorParameters<double>& actuator, const SolenoidSamples& samples);

struct ActuatorFit {
  sensor::ActuatorParameters<double> actuator;
  FluxLinkageFit flux_linkage;
  std::optional<SolenoidDynamicsFit> dynamics;  ///< only with a recording of `solenoid_dynamic`
  std::optional<LoopWidths> loop_widths;        ///< only without
  model::Fit friction;                          ///< what is known of the armature's friction
  std::vector<model::MapResidual> profiles;     ///< of the force map's strokes, over position
  FitResidual strokes_N;                        ///< of the force map's strokes about map and friction
};

struct ActuatorRecordings {
  const recording::Recording& force_map;          ///< protocol `solenoid_force_map`
  const recording::Recording* dynamic = nullptr;  ///< protocol `solenoid_dynamic`, if there is one
};

/// Without `solenoid_dynamic` the widths of the force map's loops give the size of hysteresis, its shape is a stated
/// default, eddy currents are left out, and the uncertainty is wider.
[[nodiscard]] ActuatorFit fit_actuator(const ActuatorRecordings& recordings, const MagneticForceFit& map,
                                       double stroke_m);

/// Loops of the shape that solenoid irons have in common: most of the turn after a reversal within some hundredths of
/// full flux, the rest within a tenth.
[[nodiscard]] sensor::MagneticHysteresis<double> default_hysteresis(double coercive_current_A, double full_flux_Wb);

/// The voltage rate at which excess eddy currents turn proportional: a thousandth of what drives the largest current.
[[nodiscard]] double smallest_rate_V(const FluxLinkageFit& flux_linkage, double largest_current_A);

}  // namespace spoolflow::calibration
