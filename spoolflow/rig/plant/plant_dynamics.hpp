#pragma once
/// Right-hand side of the whole plant: from states and input to all forces, flows and rates at one instant.
///
/// Differential states are {x, v}, three of each solenoid, six of the hydraulics. The memories (iron hysteresis,
/// friction elements, contact ages) are functions of flux and displacement since the step's start; temperatures move
/// once a step.
#include <array>
#include <numbers>

#include "spoolflow/rig/hydraulics/hydraulic_circuit.hpp"
#include "spoolflow/rig/plant/plant_parameters.hpp"
#include "spoolflow/rig/plant/plant_state.hpp"
#include "spoolflow/rig/plant/solenoid_dynamics.hpp"
#include "spoolflow/rig/plant/spool.hpp"

namespace spoolflow::rig {

/// What of the plant's equations does not change within one call of `step`.
template <class Scalar>
struct PlantConstantsOf {
  bool solenoid_a, solenoid_b, hydraulics;  ///< present in the arrangement
  bool magnetic_a, magnetic_b;              ///< solenoid under voltage or magnetised; else its rates are zero
  Scalar armatures;                         ///< number of armatures on the body
  Scalar mass_kg;
  Scalar spool_drag_N_s_per_m;
  Scalar armature_drag_N_s_per_m;  ///< all armatures
  FrictionConstantsOf<Scalar> spool_friction, armature_a_friction, armature_b_friction;
  Scalar density_kg_per_m3;
  Scalar viscosity_m2_per_s;
  OilStateOf<Scalar> oil;
  SolenoidConstantsOf<Scalar> solenoid_a_constants;
  SolenoidConstantsOf<Scalar> solenoid_b_constants;
  std::array<const MeteringEdgeOf<Scalar>*, 4> edges;
  std::array<EdgeConstantsOf<Scalar>, 4> edge_constants;
};
using PlantConstants = PlantConstantsOf<double>;

/// The oil at that temperature: `kept` where it is of it.
[[nodiscard]] OilState oil_of(const PlantParameters& parameters, const OilState& kept, double temperature_C);

/// Whether the source's pressure is its set value with the ripple.
[[nodiscard]] bool holds_ideally(const Load& load);

/// `state.oil` is at the input's oil temperature.
template <class Scalar>
inline PlantConstantsOf<Scalar> plant_constants(const PlantParametersOf<Scalar>& p, const PlantStateOf<Scalar>& state,
                                                const PlantInputOf<Scalar>& input) {
  PlantConstantsOf<Scalar> c{};
  c.solenoid_a = p.arrangement == Arrangement::valve;
  c.solenoid_b = p.arrangement != Arrangement::axial_force_bench;
  c.hydraulics = p.arrangement != Arrangement::solenoid_bench;
  const auto magnetic = [](const SolenoidStateOf<Scalar>& solenoid, Scalar voltage_V) {
    return any(voltage_V != 0.0 || solenoid.flux_linkage_Wb != 0.0 || solenoid.flux_Wb != 0.0 ||
               solenoid.skin_current_A != 0.0 || solenoid.iron.field_A_per_m != 0.0);
  };
  c.magnetic_a = c.solenoid_a && magnetic(state.solenoid_a, input.voltage_a_V);
  c.magnetic_b = c.solenoid_b && magnetic(state.solenoid_b, input.voltage_b_V);
  c.armatures = (c.solenoid_a ? 1.0 : 0.0) + (c.solenoid_b ? 1.0 : 0.0);
  c.mass_kg = (c.hydraulics ? p.spool.spool_mass_kg : Scalar(0.0)) + c.armatures * p.spool.armature_mass_kg;

  c.oil = state.oil;
  const Scalar mean_pressure_Pa = 0.5 * larger(Scalar(0.0), state.pressure_P_Pa);
  c.density_kg_per_m3 = density_kg_per_m3(p.oil, c.oil, mean_pressure_Pa);
  c.viscosity_m2_per_s = viscosity_m2_per_s(p.oil, c.oil, mean_pressure_Pa);
  const Scalar dynamic_viscosity_Pa_s = c.density_kg_per_m3 * c.viscosity_m2_per_s;
  if (c.hydraulics) {
    c.spool_drag_N_s_per_m =
        dynamic_viscosity_Pa_s * std::numbers::pi * p.spool.diameter_m * p.spool.land_length_m / p.spool.clearance_m;
    c.edges = {&p.edge_PA, &p.edge_PB, &p.edge_AT, &p.edge_BT};
    for (std::size_t i = 0; i < 4; ++i) {
      c.edge_constants[i] = edge_constants(*c.edges[i], p.spool.diameter_m, p.spool.clearance_m, c.density_kg_per_m3,
                                           c.viscosity_m2_per_s);
    }
  }
  c.armature_drag_N_s_per_m = c.armatures * dynamic_viscosity_Pa_s * p.spool.armature_drag_m;
  c.spool_friction = friction_constants(p.spool_friction, c.viscosity_m2_per_s);
  c.armature_a_friction = friction_constants(p.solenoid_a.friction, c.viscosity_m2_per_s);
  c.armature_b_friction = friction_constants(p.solenoid_b.friction, c.viscosity_m2_per_s);
  c.solenoid_a_constants = solenoid_constants(p.solenoid_a, state.solenoid_a.heat);
  c.solenoid_b_constants = solenoid_constants(p.solenoid_b, state.solenoid_b.heat);
  return c;
}

/// The differential states, as the integrator sees them, in this order.
enum PlantIndex {
  state_x = 0,
  state_v = 1,
  state_solenoid_a = 2,
  state_solenoid_b = state_solenoid_a + solenoid_states,
  state_hydraulics = state_solenoid_b + solenoid_states,
  plant_states = state_hydraulics + hydraulic_states
};
template <class Scalar>
using PlantVectorOf = std::array<Scalar, plant_states>;
using PlantVector = PlantVectorOf<double>;

template <std::size_t offset, std::size_t count, class Vector>
auto block(Vector& u) {
  return std::span(u).template subspan<offset, count>();
}
template <class Vector>
auto solenoid_a_of(Vector& u) {
  return block<state_solenoid_a, solenoid_states>(u);
}
template <class Vector>
auto solenoid_b_of(Vector& u) {
  return block<state_solenoid_b, solenoid_states>(u);
}
template <class Vector>
auto hydraulics_of(Vector& u) {
  return block<state_hydraulics, hydraulic_states>(u);
}

template <class Scalar>
struct ContactAgesOf {
  Scalar spool, armature_a, armature_b;
};
using ContactAges = ContactAgesOf<double>;

template <class Scalar>
inline PlantVectorOf<Scalar> differential_states(const PlantStateOf<Scalar>& s) {
  return {s.position_m,
          s.velocity_m_per_s,
          s.solenoid_a.flux_linkage_Wb,
          s.solenoid_a.flux_Wb,
          s.solenoid_a.skin_current_A,
          s.solenoid_b.flux_linkage_Wb,
          s.solenoid_b.flux_Wb,
          s.solenoid_b.skin_current_A,
          s.pressure_P_Pa,
          s.pressure_A_Pa,
          s.pressure_B_Pa,
          s.hold_flow_m3_per_s,
          s.cylinder_position_m,
          s.cylinder_velocity_m_per_s};
}

/// What acts at one instant; forces towards -x but for the magnetic ones.
template <class Scalar>
struct PlantRatesOf {
  SolenoidRatesOf<Scalar> solenoid_a{}, solenoid_b{};
  HydraulicRatesOf<Scalar> hydraulics;
  std::array<EdgeForceOf<Scalar>, 4> edge_forces;
  std::array<Scalar, 4> transient_N;  ///< of each edge
  Scalar spool_breakaway_N, armature_a_breakaway_N, armature_b_breakaway_N;
  FrictionForceOf<Scalar> spool_friction{}, armature_a_friction{}, armature_b_friction{};
  SpringForceOf<Scalar> spring{};
  EndStopForceOf<Scalar> end_stop;
  Scalar flow_force_N = 0.0;
  Scalar drag_N;
  PlantVectorOf<Scalar> rate{};  ///< of the free body
};
using PlantRates = PlantRatesOf<double>;

/// `start` holds the memories and the states they count from; `time_s` is for the ripple. Fills what the arrangement
/// has of `out` and leaves the rest as it is.
template <class Scalar>
// long: the whole right-hand side of the equations of motion, in the order of its states
inline void plant_rates(const PlantParametersOf<Scalar>& p, const PlantConstantsOf<Scalar>& c,
                        const PlantStateOf<Scalar>& start, const PlantInputOf<Scalar>& input,
                        const PlantVectorOf<Scalar>& u, const ContactAgesOf<Scalar>& ages, Given<Scalar> time_s,
                        PlantRatesOf<Scalar>& out) {
  const Scalar x = u[state_x];
  const Scalar v = u[state_v];
  const Scalar displacement = x - start.position_m;
  Scalar force = 0.0;  // towards +x
  if (c.solenoid_a) {
    if (c.magnetic_a)
      out.solenoid_a = solenoid_rates(c.solenoid_a_constants, start.solenoid_a, solenoid_a_of(u), -x, input.voltage_a_V,
                                      solenoid_a_of(out.rate));
    out.armature_a_breakaway_N =
        breakaway_N(c.armature_a_friction, p.solenoid_a.side_friction_coefficient * out.solenoid_a.side_force_N,
                    ages.armature_a, v);
    out.armature_a_friction =
        friction_force(c.armature_a_friction, start.solenoid_a.friction, displacement, v, out.armature_a_breakaway_N);
    force -= out.solenoid_a.magnetic_force_N + out.armature_a_friction.force_N;
  }
  if (c.solenoid_b) {
    if (c.magnetic_b)
      out.solenoid_b = solenoid_rates(c.solenoid_b_constants, start.solenoid_b, solenoid_b_of(u), x, input.voltage_b_V,
                                      solenoid_b_of(out.rate));
    out.armature_b_breakaway_N =
        breakaway_N(c.armature_b_friction, p.solenoid_b.side_friction_coefficient * out.solenoid_b.side_force_N,
                    ages.armature_b, v);
    out.armature_b_friction =
        friction_force(c.armature_b_friction, start.solenoid_b.friction, displacement, v, out.armature_b_breakaway_N);
    force += out.solenoid_b.magnetic_force_N - out.armature_b_friction.force_N;
  }
  if (c.hydraulics) {
    const HydraulicBoundaryOf<Scalar> boundary = hydraulic_boundary(
        p.supply, p.load, input.supply_pressure_Pa, input.held_pressure_difference_Pa, input.load_force_N, time_s);
    hydraulic_rates(c.edges, c.edge_constants, p.supply, p.load, p.oil, c.oil, c.density_kg_per_m3, boundary,
                    hydraulics_of(u), x, out.hydraulics, hydraulics_of(out.rate));
    Scalar pressure_sum = 0.0;
    Scalar lateral = 0.0;
    Scalar flow_force = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const EdgeFlowOf<Scalar>& edge = out.hydraulics.edges[i];
      out.edge_forces[i] = edge_force(p.flow_force, c.edge_constants[i], edge, c.viscosity_m2_per_s);
      const Scalar flow_rate = edge.flow_gain_m2_per_s * edge_side[i] * v +
                               edge.conductance_m3_per_s_Pa * out.hydraulics.difference_rate_Pa_per_s[i];
      out.transient_N[i] =
          edge_side[i] * transient_force_N(c.edge_constants[i], c.density_kg_per_m3, c.edges[i]->damping_length_m,
                                           flow_rate, out.hydraulics.difference_Pa[i]);
      flow_force += edge_side[i] * out.edge_forces[i].steady_N + out.transient_N[i];
      pressure_sum += magnitude(out.hydraulics.difference_Pa[i]);
      lateral += out.edge_forces[i].lateral_N;
    }
    out.flow_force_N = flow_force;
    const Scalar load =
        0.5 * p.flow_force.friction_per_pressure_N_per_Pa * pressure_sum + p.flow_force.lateral_friction * lateral;
    out.spool_breakaway_N = breakaway_N(c.spool_friction, load, ages.spool, v);
    out.spool_friction = friction_force(c.spool_friction, start.spool_friction, displacement, v, out.spool_breakaway_N);
    out.spring = centring_force(p.spring_a, p.spring_b, p.spool.washer_play_m, x);
    force -= flow_force + out.spool_friction.force_N + out.spring.force_N;
  }
  out.end_stop = end_stop_force(p.spool, x, v);
  out.drag_N = (c.spool_drag_N_s_per_m + c.armature_drag_N_s_per_m) * v;
  out.rate[state_x] = v;
  out.rate[state_v] = (force + input.foreign_force_N - out.drag_N - out.end_stop.force_N) / c.mass_kg;
}

}  // namespace spoolflow::rig
