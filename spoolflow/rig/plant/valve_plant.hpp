#pragma once
/// The plant of the virtual test rig: a 4/3 valve with two solenoids, its oil, supply and load; or parts of it on a
/// bench.
///
/// Signs (as the project's physics): x > 0 opens P to B and A to T and is pulled by solenoid b; solenoid a pulls to x <
/// 0. Magnetic force > 0 pulls to +x; spring, flow and friction forces are counted as resisting, > 0 towards -x, so
///
///     m dv/dt = F_mag - F_fric,act - F_spr - F_ff - F_fric,hydr - F_drag - F_stop
///
/// and for x > 0 spring and steady flow force close (+), friction has the sign of v. Pressures are gauge. Edge flows
/// are positive in the direction of the edge's name (P to B, A to T).
///
///     PlantParameters parameters;                // a size-6 valve on a bench that holds the pressure difference
///     check_ranges(parameters);                  // throws std::invalid_argument, naming value and range
///     PlantState state = plant_at_rest(parameters, input);
///     step(parameters, state, input, 1e-4);      // one electronics period; input held over it
///     PlantOutput truth = observe(parameters, state, input);
#include "spoolflow/rig/plant/plant_output.hpp"
#include "spoolflow/rig/plant/plant_parameters.hpp"
#include "spoolflow/rig/plant/plant_state.hpp"

namespace spoolflow::rig {

/// The plant at rest at spool centre (or the prescribed position), unmagnetised, contacts relaxed, in thermal and
/// hydraulic equilibrium with its surroundings and no current.
PlantState plant_at_rest(const PlantParameters& parameters, const PlantInput& input);

/// Advances the plant by dt_s with the input held; internally in steps as Integration allows.
void step(const PlantParameters& parameters, PlantState& state, const PlantInput& input, double dt_s);

/// Ground truth at the state's instant.
PlantOutput observe(const PlantParameters& parameters, const PlantState& state, const PlantInput& input);

}  // namespace spoolflow::rig
