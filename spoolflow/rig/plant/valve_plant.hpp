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
#include "spoolflow/rig/plant/plant_parameters.hpp"
#include "spoolflow/rig/plant/plant_state.hpp"

namespace spoolflow::rig {

/// Ground truth of one solenoid.
struct SolenoidOutput {
  double current_A = 0.0;
  double flux_linkage_Wb = 0.0;
  double flux_Wb = 0.0;
  double eddy_current_A = 0.0;    ///< one-turn equivalent, opposing
  double magnetic_force_N = 0.0;  ///< towards its own pole, >= 0
  double side_force_N = 0.0;
  double friction_force_N = 0.0;  ///< sign of v in its own pull direction reversed to the spool's x
  double resistance_ohm = 0.0;
  double winding_temperature_C = 0.0;
  double housing_temperature_C = 0.0;
};

/// Ground truth of one metering edge.
struct EdgeOutput {
  double flow_m3_per_s = 0.0;     ///< through the notches and the clearance, in the direction of its name
  double leakage_m3_per_s = 0.0;  ///< the clearance's part
  double pressure_difference_Pa = 0.0;
  double area_m2 = 0.0;
  double jet_angle_rad = 0.0;
  double steady_force_N = 0.0;     ///< towards -x
  double transient_force_N = 0.0;  ///< towards -x
  double lateral_force_N = 0.0;
};

/// Ground truth of the open path, of both edges that the spool opens: P to B and A to T for x >= 0, P to A and B to T
/// below.
struct PathOutput {
  /// What the valve sends through the load, > 0 out of port B: of port B for x >= 0, of port A below (a differential
  /// cylinder's ports differ), each less what leaks past the closed edge. On the bench of the return edge, of port A.
  double flow_m3_per_s = 0.0;
  double pressure_difference_Pa = 0.0;  ///< over both edges, added: P to T less what the load takes
  double upstream_pressure_Pa = 0.0;    ///< of the port that is fed
};

/// Everything true at one instant.
struct PlantOutput {
  double time_s = 0.0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double acceleration_m_per_s2 = 0.0;
  SolenoidOutput solenoid_a;
  SolenoidOutput solenoid_b;
  double magnetic_force_N = 0.0;           ///< net, towards +x
  double armature_friction_force_N = 0.0;  ///< both armatures
  double spring_force_N = 0.0;
  double flow_force_N = 0.0;  ///< steady and transient, all edges
  double spool_friction_force_N = 0.0;
  double drag_force_N = 0.0;
  double end_stop_force_N = 0.0;
  double axial_force_N = 0.0;      ///< F_ax between armatures and spool, paper equation (1), towards +x
  double load_cell_force_N = 0.0;  ///< what the bench's load cell reads: the armature's push, or the force needed to
                                   ///< hold the spool, both > 0 towards +x; 0 for the whole valve
  EdgeOutput edge_PA;
  EdgeOutput edge_PB;
  EdgeOutput edge_AT;
  EdgeOutput edge_BT;
  double pressure_P_Pa = 0.0;
  double pressure_A_Pa = 0.0;
  double pressure_B_Pa = 0.0;
  double pressure_T_Pa = 0.0;
  double pressure_difference_Pa = 0.0;  ///< over the edge the spool opens: P to B for x >= 0, P to A below; where the
                                        ///< bench joins A and B or feeds A, that of the path
  double flow_m3_per_s = 0.0;           ///< through that edge or path, > 0 as it opens
  PathOutput path;
  double oil_density_kg_per_m3 = 0.0;
  double oil_viscosity_m2_per_s = 0.0;
  double cylinder_position_m = 0.0;        ///< turns of a motor [rad]
  double cylinder_velocity_m_per_s = 0.0;  ///< of a motor [rad/s]
};

/// The plant at rest at spool centre (or the prescribed position), unmagnetised, contacts relaxed, in thermal and
/// hydraulic equilibrium with its surroundings and no current.
PlantState plant_at_rest(const PlantParameters& parameters, const PlantInput& input);

/// Advances the plant by dt_s with the input held; internally in steps as Integration allows.
void step(const PlantParameters& parameters, PlantState& state, const PlantInput& input, double dt_s);

/// Ground truth at the state's instant.
PlantOutput observe(const PlantParameters& parameters, const PlantState& state, const PlantInput& input);

}  // namespace spoolflow::rig
