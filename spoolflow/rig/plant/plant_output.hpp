#pragma once
/// What is true of the plant at one instant.

namespace spoolflow::rig {

/// Ground truth of one solenoid.
template <class Scalar>
struct SolenoidOutputOf {
  Scalar current_A = 0.0;
  Scalar flux_linkage_Wb = 0.0;
  Scalar flux_Wb = 0.0;
  Scalar eddy_current_A = 0.0;    ///< one-turn equivalent, opposing
  Scalar magnetic_force_N = 0.0;  ///< towards its own pole, >= 0
  Scalar side_force_N = 0.0;
  Scalar friction_force_N = 0.0;  ///< sign of v in its own pull direction reversed to the spool's x
  Scalar resistance_ohm = 0.0;
  Scalar winding_temperature_C = 0.0;
  Scalar housing_temperature_C = 0.0;
};
using SolenoidOutput = SolenoidOutputOf<double>;

/// Ground truth of one metering edge.
template <class Scalar>
struct EdgeOutputOf {
  Scalar flow_m3_per_s = 0.0;     ///< through the notches and the clearance, in the direction of its name
  Scalar leakage_m3_per_s = 0.0;  ///< the clearance's part
  Scalar pressure_difference_Pa = 0.0;
  Scalar area_m2 = 0.0;
  Scalar jet_angle_rad = 0.0;
  Scalar steady_force_N = 0.0;     ///< towards -x
  Scalar transient_force_N = 0.0;  ///< towards -x
  Scalar lateral_force_N = 0.0;
};
using EdgeOutput = EdgeOutputOf<double>;

/// Ground truth of the open path, of both edges that the spool opens: P to B and A to T for x >= 0, P to A and B to T
/// below.
template <class Scalar>
struct PathOutputOf {
  /// What the valve sends through the load, > 0 out of port B: of port B for x >= 0, of port A below (a differential
  /// cylinder's ports differ), each less what leaks past the closed edge. On the bench of the return edge, of port A.
  Scalar flow_m3_per_s = 0.0;
  Scalar pressure_difference_Pa = 0.0;  ///< over both edges, added: P to T less what the load takes
  Scalar upstream_pressure_Pa = 0.0;    ///< of the port that is fed
};

/// Everything true at one instant.
template <class Scalar>
struct PlantOutputOf {
  Scalar time_s = 0.0;
  Scalar position_m = 0.0;
  Scalar velocity_m_per_s = 0.0;
  Scalar acceleration_m_per_s2 = 0.0;
  SolenoidOutputOf<Scalar> solenoid_a;
  SolenoidOutputOf<Scalar> solenoid_b;
  Scalar magnetic_force_N = 0.0;           ///< net, towards +x
  Scalar armature_friction_force_N = 0.0;  ///< both armatures
  Scalar spring_force_N = 0.0;
  Scalar flow_force_N = 0.0;  ///< steady and transient, all edges
  Scalar spool_friction_force_N = 0.0;
  Scalar drag_force_N = 0.0;
  Scalar end_stop_force_N = 0.0;
  Scalar axial_force_N = 0.0;      ///< F_ax between armatures and spool, paper equation (1), towards +x
  Scalar load_cell_force_N = 0.0;  ///< what the bench's load cell reads: the armature's push, or the force needed to
                                   ///< hold the spool, both > 0 towards +x; 0 for the whole valve
  EdgeOutputOf<Scalar> edge_PA;
  EdgeOutputOf<Scalar> edge_PB;
  EdgeOutputOf<Scalar> edge_AT;
  EdgeOutputOf<Scalar> edge_BT;
  Scalar pressure_P_Pa = 0.0;
  Scalar pressure_A_Pa = 0.0;
  Scalar pressure_B_Pa = 0.0;
  Scalar pressure_T_Pa = 0.0;
  Scalar pressure_difference_Pa = 0.0;  ///< over the edge the spool opens: P to B for x >= 0, P to A below; where the
                                        ///< bench joins A and B or feeds A, that of the path
  Scalar flow_m3_per_s = 0.0;           ///< through that edge or path, > 0 as it opens
  PathOutputOf<Scalar> path;
  Scalar oil_density_kg_per_m3 = 0.0;
  Scalar oil_viscosity_m2_per_s = 0.0;
  Scalar cylinder_position_m = 0.0;        ///< turns of a motor [rad]
  Scalar cylinder_velocity_m_per_s = 0.0;  ///< of a motor [rad/s]
};
using PlantOutput = PlantOutputOf<double>;

}  // namespace spoolflow::rig
