#pragma once
/// Ground truth of the plant at one instant, from its equations.
#include <cmath>

#include "spoolflow/rig/plant/plant_memory.hpp"
#include "spoolflow/rig/plant/plant_output.hpp"

namespace spoolflow::rig {

inline double angle_of(double sine, double cosine) {
  return std::atan2(sine, cosine);
}

template <class Scalar>
inline EdgeOutputOf<Scalar> edge_output(const PlantRatesOf<Scalar>& rates, std::size_t index) {
  const EdgeFlowOf<Scalar>& flow = rates.hydraulics.edges[index];
  const EdgeForceOf<Scalar>& force = rates.edge_forces[index];
  return {.flow_m3_per_s = flow.flow_m3_per_s,
          .leakage_m3_per_s = flow.leakage_m3_per_s,
          .pressure_difference_Pa = rates.hydraulics.difference_Pa[index],
          .area_m2 = flow.area_m2,
          .jet_angle_rad = angle_of(force.jet.sine, force.jet.cosine),
          .steady_force_N = edge_side[index] * force.steady_N,
          .transient_force_N = rates.transient_N[index],
          .lateral_force_N = force.lateral_N};
}

template <class Scalar>
inline SolenoidOutputOf<Scalar> solenoid_output(const SolenoidStateOf<Scalar>& state,
                                                const SolenoidConstantsOf<Scalar>& constants,
                                                const SolenoidRatesOf<Scalar>& rates, Scalar friction_N) {
  return {.current_A = rates.current_A,
          .flux_linkage_Wb = state.flux_linkage_Wb,
          .flux_Wb = state.flux_Wb,
          .eddy_current_A = rates.eddy_current_A,
          .magnetic_force_N = rates.magnetic_force_N,
          .side_force_N = rates.side_force_N,
          .friction_force_N = friction_N,
          .resistance_ohm = constants.resistance_ohm,
          .winding_temperature_C = state.heat.winding_temperature_C,
          .housing_temperature_C = state.heat.housing_temperature_C};
}

/// The edges that the spool opens, as one path.
template <class Scalar>
inline PathOutputOf<Scalar> open_path(const PlantParametersOf<Scalar>& p, const PlantOutputOf<Scalar>& out) {
  const bool return_alone = p.load.kind == LoadKind::held_return;
  // Fed through A alone, the bench's sensors stand over A to T wherever the spool is.
  const Mask<Scalar> right = out.position_m >= (return_alone ? -1.0 : 0.0);
  const EdgeOutputOf<Scalar> inlet = blended(right, out.edge_PB, out.edge_PA);
  const EdgeOutputOf<Scalar> outlet = blended(right, out.edge_AT, out.edge_BT);
  const Scalar from_B_m3_per_s = out.edge_PB.flow_m3_per_s - out.edge_BT.flow_m3_per_s;
  const Scalar into_A_m3_per_s = out.edge_AT.flow_m3_per_s - out.edge_PA.flow_m3_per_s;
  return {.flow_m3_per_s = return_alone ? into_A_m3_per_s : select(right, from_B_m3_per_s, into_A_m3_per_s),
          .pressure_difference_Pa = inlet.pressure_difference_Pa + outlet.pressure_difference_Pa,
          .upstream_pressure_Pa = return_alone ? out.pressure_A_Pa : out.pressure_P_Pa};
}

/// Every edge, the one that the spool opens, and the path; `out` has position and pressures.
template <class Scalar>
inline void observe_edges(const PlantParametersOf<Scalar>& p, const PlantRatesOf<Scalar>& r,
                          PlantOutputOf<Scalar>& out) {
  out.edge_PA = edge_output(r, edge_PA);
  out.edge_PB = edge_output(r, edge_PB);
  out.edge_AT = edge_output(r, edge_AT);
  out.edge_BT = edge_output(r, edge_BT);
  const EdgeOutputOf<Scalar> opened = blended(out.position_m >= 0.0, out.edge_PB, out.edge_PA);
  out.pressure_difference_Pa = opened.pressure_difference_Pa;
  out.flow_m3_per_s = opened.flow_m3_per_s;
  out.path = open_path(p, out);
  if (p.load.kind == LoadKind::held_path || p.load.kind == LoadKind::held_return) {
    out.pressure_difference_Pa = out.path.pressure_difference_Pa;
    out.flow_m3_per_s = out.path.flow_m3_per_s;
    if (p.load.kind == LoadKind::held_path) {
      out.flow_m3_per_s = select(out.position_m < 0.0, -out.path.flow_m3_per_s, out.path.flow_m3_per_s);
    }
  }
}

/// Ground truth of a state whose oil has the input's temperature, and whose pressure is the source's where it is held
/// ideally.
template <class Scalar>
inline PlantOutputOf<Scalar> observed(const PlantParametersOf<Scalar>& p, const PlantStateOf<Scalar>& state,
                                      const PlantInputOf<Scalar>& input) {
  const PlantConstantsOf<Scalar> c = plant_constants(p, state, input);
  PlantRatesOf<Scalar> r{};
  plant_rates(p, c, state, input, differential_states(state), contact_ages(state), state.time_s, r);

  PlantOutputOf<Scalar> out;
  out.time_s = state.time_s;
  out.position_m = state.position_m;
  out.velocity_m_per_s = state.velocity_m_per_s;
  out.acceleration_m_per_s2 = input.motion ? input.motion->acceleration_m_per_s2 : r.rate[state_v];
  if (c.solenoid_a) {
    out.solenoid_a =
        solenoid_output(state.solenoid_a, c.solenoid_a_constants, r.solenoid_a, r.armature_a_friction.force_N);
  }
  if (c.solenoid_b) {
    out.solenoid_b =
        solenoid_output(state.solenoid_b, c.solenoid_b_constants, r.solenoid_b, r.armature_b_friction.force_N);
  }
  out.magnetic_force_N = out.solenoid_b.magnetic_force_N - out.solenoid_a.magnetic_force_N;
  out.armature_friction_force_N = out.solenoid_a.friction_force_N + out.solenoid_b.friction_force_N;
  out.spring_force_N = r.spring.force_N;
  out.flow_force_N = r.flow_force_N;
  out.spool_friction_force_N = r.spool_friction.force_N;
  out.drag_force_N = r.drag_N;
  out.end_stop_force_N = r.end_stop.force_N;

  const Scalar armature_drag_N = c.armature_drag_N_s_per_m * state.velocity_m_per_s;
  const Scalar armature_mass_kg = c.armatures * p.spool.armature_mass_kg;
  out.axial_force_N = out.magnetic_force_N - out.armature_friction_force_N - armature_drag_N -
                      armature_mass_kg * out.acceleration_m_per_s2;
  if (p.arrangement == Arrangement::solenoid_bench) {
    out.load_cell_force_N = out.axial_force_N - out.end_stop_force_N;
  } else if (p.arrangement == Arrangement::axial_force_bench) {
    out.load_cell_force_N = out.spring_force_N + out.flow_force_N + out.spool_friction_force_N + out.drag_force_N +
                            out.end_stop_force_N + c.mass_kg * out.acceleration_m_per_s2;
  }

  const bool held = holds_difference(p.load.kind);
  out.pressure_P_Pa = out.path.upstream_pressure_Pa = state.pressure_P_Pa;
  out.pressure_A_Pa = state.pressure_A_Pa;
  out.pressure_B_Pa = state.pressure_B_Pa;
  out.pressure_T_Pa = held ? p.supply.back_pressure_Pa : p.supply.tank_pressure_Pa;
  if (c.hydraulics) observe_edges(p, r, out);
  out.oil_density_kg_per_m3 = c.density_kg_per_m3;
  out.oil_viscosity_m2_per_s = c.viscosity_m2_per_s;
  out.cylinder_position_m = state.cylinder_position_m;
  out.cylinder_velocity_m_per_s = state.cylinder_velocity_m_per_s;
  return out;
}

}  // namespace spoolflow::rig
