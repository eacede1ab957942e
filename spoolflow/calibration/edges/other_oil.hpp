#pragma once
/// What the edge does with oil of another temperature than the one at which it was measured.
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/metering_edge.hpp"

namespace spoolflow::calibration {

/// Gives the outer layers of an edge, whose layers are all alike and were measured at `measured_K`, what the orifice
/// does at their temperatures. Density and viscosity alone change: the pressure difference is a sum of a part in
/// proportion to density and to the square of the flow rate and one in proportion to both viscosity and the flow rate;
/// the flow force over the pressure difference changes with the root of 1/Re, with its boundary layer. Both laws are
/// fitted to the measured pressure differences; friction stays.
void continue_to_other_oil(sensor::MeteringEdge<double>& edge, double measured_K, const model::Fluid& fluid);

}  // namespace spoolflow::calibration
