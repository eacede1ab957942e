#pragma once
/// What an operating run must satisfy beside the valve's curves.
#include <string>
#include <vector>

#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/valve_curves.hpp"

namespace spoolflow::plausibility {

/// Rows in which the spool stands open to one side (+1 or -1), in that side's signs, with that side's coil, or with the
/// active one where that alone was recorded.
[[nodiscard]] recording::Recording one_side(const recording::Recording& run, int side);

/// Leaves the positions > 0 of a run that goes through the centre of a whole valve: the side that a model of one
/// direction knows. Of a valve of one direction no run goes so far to both sides of its closed end.
void keep_known_side(recording::Recording& run, double stroke_m);

/// What edge and pressure difference make of a run's positions, block by block [m3/s]; at the valve's highest pressure
/// difference where none was recorded.
[[nodiscard]] std::vector<double> expected_flow(const HydraulicCurves& hydraulics, const recording::Recording& run);

/// Of an operating run against both: balance of forces, flow against what edge and pressure difference make, positions.
/// Reads current, position, and of flow and pressure difference what is there; the flow in the rows as they are, as a
/// meter's lag may be shorter than the stretches over which forces are judged (longer_blocks()).
void add_run_deviations(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                        const recording::Recording& run);

/// What says that a run's spool stands against its open stop: at its highest position the solenoid pulls harder than
/// springs, flow force and all friction that the run shows below it hold. Empty without current, position, and flow or
/// pressure difference, and where the stop is known. `run` is block means of one direction.
[[nodiscard]] std::string undeclared_open_stop(const KnownValve& valve, const recording::Recording& run);

}  // namespace spoolflow::plausibility
