#pragma once
#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/sensor/actuator.hpp"

namespace spoolflow::calibration {

/// Sets how unsure the actuator is of its force, so that the squares of its deviations from the load cell are
/// explained: a constant, a part with the force's slope over current, and a part with the eddy current. `actuator` is
/// otherwise complete; the armature is held during the recording.
void fit_uncertainty(sensor::ActuatorParameters<double>& actuator, const SolenoidSamples& samples);

}  // namespace spoolflow::calibration
