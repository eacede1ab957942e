#pragma once
/// What of the plant's equations does not change within one call of `step`.
#include <array>
#include <numbers>

#include "spoolflow/rig/hydraulics/hydraulic_circuit.hpp"
#include "spoolflow/rig/plant/plant_parameters.hpp"
#include "spoolflow/rig/plant/plant_state.hpp"
#include "spoolflow/rig/plant/solenoid_dynamics.hpp"

namespace spoolflow::rig {

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

}  // namespace spoolflow::rig
