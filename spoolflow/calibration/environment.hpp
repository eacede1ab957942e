#pragma once
/// What a declared machine leaves open, as the sensor's own numbers of one valve.
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/environment.hpp"

namespace spoolflow::calibration {

/// Puts the environment into every observer of the model, in place of the one before; a model without observer stays as
/// it is. What is open of the unit itself stays, too: what units of its type differ by, and what its references leave
/// open. `environment.highest_Pa` below the calibrated pressure difference leaves that.
void apply(const recording::Environment& environment, model::Model& model);

/// Reports every observer of the model how the coil current changes at most between two samples, by the coil's
/// equation: voltage, and the current's own, over the least incremental inductance, and at once the eddy currents of
/// that voltage. Nothing where the recordings held no voltage.
void limit_currents(model::Model& model);

}  // namespace spoolflow::calibration
