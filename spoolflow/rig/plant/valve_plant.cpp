#include "spoolflow/rig/plant/valve_plant.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "spoolflow/rig/plant/plant_integrator.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

void refresh_oil(const PlantParameters& parameters, PlantState& state, double temperature_C) {
  if (state.oil.temperature_C != temperature_C || state.oil.density_kg_per_m3 == 0.0) {
    state.oil = oil_at(parameters.oil, temperature_C);
  }
}

double source_pressure_Pa(const PlantParameters& p, const PlantInput& input, double time_s) {
  return hydraulic_boundary(p.supply, p.load, input.supply_pressure_Pa, input.held_pressure_difference_Pa,
                            input.load_force_N, time_s)
      .source_pressure_Pa;
}

bool holds_ideally(const PlantParameters& p) {
  return p.load.ideal_hold && (p.load.kind == LoadKind::held_difference || p.load.kind == LoadKind::held_path);
}

[[noreturn]] void diverged(const PlantState& state, double h) {
  std::array<char, 320> text{};  // no library but the compiler's own: the plant also runs inside an FMU
  std::snprintf(
      text.data(), text.size(),
      "the plant has no finite state %.3g s after t = %.6f s (position %.4g mm, velocity %.4g m/s, pressure P "
      "%.4g bar): check that every parameter is inside its range, then choose a smaller "
      "integration.shortest_step_s",
      h, state.time_s, units::mm_from_m(state.position_m), state.velocity_m_per_s,
      units::bar_from_Pa(state.pressure_P_Pa));
  throw std::runtime_error(text.data());
}

EdgeOutput edge_output(const PlantRates& rates, std::size_t index) {
  const EdgeFlow& flow = rates.hydraulics.edges[index];
  const EdgeForce& force = rates.edge_forces[index];
  return {.flow_m3_per_s = flow.flow_m3_per_s,
          .leakage_m3_per_s = flow.leakage_m3_per_s,
          .pressure_difference_Pa = rates.hydraulics.difference_Pa[index],
          .area_m2 = flow.area_m2,
          .jet_angle_rad = std::atan2(force.jet.sine, force.jet.cosine),
          .steady_force_N = edge_side[index] * force.steady_N,
          .transient_force_N = rates.transient_N[index],
          .lateral_force_N = force.lateral_N};
}

SolenoidOutput solenoid_output(const SolenoidState& state, const SolenoidConstants& constants,
                               const SolenoidRates& rates, double friction_N) {
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
PathOutput open_path(const PlantParameters& p, const PlantOutput& out) {
  const bool right = out.position_m >= 0.0;
  const EdgeOutput& inlet = right ? out.edge_PB : out.edge_PA;
  const EdgeOutput& outlet = right ? out.edge_AT : out.edge_BT;
  const double from_B_m3_per_s = out.edge_PB.flow_m3_per_s - out.edge_BT.flow_m3_per_s;
  const double into_A_m3_per_s = out.edge_AT.flow_m3_per_s - out.edge_PA.flow_m3_per_s;
  const bool return_alone = p.load.kind == LoadKind::held_return;
  return {.flow_m3_per_s = right && !return_alone ? from_B_m3_per_s : into_A_m3_per_s,
          .pressure_difference_Pa = inlet.pressure_difference_Pa + outlet.pressure_difference_Pa,
          .upstream_pressure_Pa = return_alone ? out.pressure_A_Pa : out.pressure_P_Pa};
}

/// Every edge, the one that the spool opens, and the path; `out` has position and pressures.
void observe_edges(const PlantParameters& p, const PlantRates& r, PlantOutput& out) {
  out.edge_PA = edge_output(r, edge_PA);
  out.edge_PB = edge_output(r, edge_PB);
  out.edge_AT = edge_output(r, edge_AT);
  out.edge_BT = edge_output(r, edge_BT);
  const EdgeOutput& opened = out.position_m >= 0.0 ? out.edge_PB : out.edge_PA;
  out.pressure_difference_Pa = opened.pressure_difference_Pa;
  out.flow_m3_per_s = opened.flow_m3_per_s;
  out.path = open_path(p, out);
  if (p.load.kind == LoadKind::held_path || p.load.kind == LoadKind::held_return) {
    out.pressure_difference_Pa = out.path.pressure_difference_Pa;
    const bool opens_to_A = p.load.kind == LoadKind::held_path && out.position_m < 0.0;
    out.flow_m3_per_s = opens_to_A ? -out.path.flow_m3_per_s : out.path.flow_m3_per_s;
  }
}

}  // namespace

PlantConstants plant_constants(const PlantParameters& p, const PlantState& state, const PlantInput& input) {
  PlantConstants c{};
  c.solenoid_a = p.arrangement == Arrangement::valve;
  c.solenoid_b = p.arrangement != Arrangement::axial_force_bench;
  c.hydraulics = p.arrangement != Arrangement::solenoid_bench;
  const auto magnetic = [](const SolenoidState& solenoid, double voltage_V) {
    return voltage_V != 0.0 || solenoid.flux_linkage_Wb != 0.0 || solenoid.flux_Wb != 0.0 ||
           solenoid.skin_current_A != 0.0 || solenoid.iron.field_A_per_m != 0.0;
  };
  c.magnetic_a = c.solenoid_a && magnetic(state.solenoid_a, input.voltage_a_V);
  c.magnetic_b = c.solenoid_b && magnetic(state.solenoid_b, input.voltage_b_V);
  c.armatures = (c.solenoid_a ? 1.0 : 0.0) + (c.solenoid_b ? 1.0 : 0.0);
  c.mass_kg = (c.hydraulics ? p.spool.spool_mass_kg : 0.0) + c.armatures * p.spool.armature_mass_kg;

  c.oil = state.oil;
  const double mean_pressure_Pa = 0.5 * std::max(0.0, state.pressure_P_Pa);
  c.density_kg_per_m3 = density_kg_per_m3(p.oil, c.oil, mean_pressure_Pa);
  c.viscosity_m2_per_s = viscosity_m2_per_s(p.oil, c.oil, mean_pressure_Pa);
  const double dynamic_viscosity_Pa_s = c.density_kg_per_m3 * c.viscosity_m2_per_s;
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

PlantState plant_at_rest(const PlantParameters& p, const PlantInput& input) {
  PlantState state;
  refresh_oil(p, state, input.oil_temperature_C);
  if (input.motion) state.position_m = input.motion->position_m;
  const bool held = holds_difference(p.load.kind);
  state.pressure_P_Pa = source_pressure_Pa(p, input, 0.0);
  state.pressure_A_Pa = state.pressure_B_Pa =
      held ? p.supply.back_pressure_Pa : 0.5 * (state.pressure_P_Pa + p.supply.tank_pressure_Pa);
  if (p.load.kind == LoadKind::held_return) std::swap(state.pressure_P_Pa, state.pressure_A_Pa);
  if (p.load.kind == LoadKind::held_path) {  // leakage over both lands of the closed valve
    state.pressure_A_Pa = state.pressure_B_Pa = 0.5 * (state.pressure_P_Pa + p.supply.back_pressure_Pa);
  }
  if (!held && p.load.return_to_tank) state.pressure_A_Pa = state.pressure_B_Pa = p.supply.tank_pressure_Pa;
  for (auto [solenoid, heat] :
       {std::pair{&p.solenoid_a, &state.solenoid_a.heat}, {&p.solenoid_b, &state.solenoid_b.heat}}) {
    const double to_ambient = solenoid->heat.housing_to_ambient_W_per_K;
    const double to_oil = solenoid->heat.housing_to_oil_W_per_K;
    heat->winding_temperature_C = heat->housing_temperature_C =
        (to_ambient * input.ambient_temperature_C + to_oil * input.oil_temperature_C) / (to_ambient + to_oil);
  }
  return state;
}

void step(const PlantParameters& p, PlantState& state, const PlantInput& input, double dt_s) {
  refresh_oil(p, state, input.oil_temperature_C);
  const PlantConstants c = plant_constants(p, state, input);
  const ErrorScale scale(p, c);
  ImposedPath path{};
  if (input.motion) {
    path = {state.position_m, state.velocity_m_per_s, input.motion->position_m, input.motion->velocity_m_per_s, dt_s};
  }
  const StepContext context{p, c, input, scale, input.motion ? &path : nullptr, state.time_s};
  PlantLosses losses;

  // Steps lie on a grid of dt/(count 2^levels); position and stride count in ticks of that grid.
  constexpr double grow = 1.0 / 16.0;  // of the tolerance: doubling multiplies the estimate by about eight
  const double count = std::max(1.0, std::ceil(dt_s / p.integration.longest_step_s - 1e-6));
  const double longest = dt_s / count;
  double finest = longest;
  std::int64_t ticks_per_longest = 1;
  while (ticks_per_longest < 1 << 20 && 0.5 * finest >= p.integration.shortest_step_s) {
    finest *= 0.5;
    ticks_per_longest *= 2;
  }
  const std::int64_t end = static_cast<std::int64_t>(count) * ticks_per_longest;
  std::int64_t tick = 0;
  std::int64_t stride = ticks_per_longest;
  while (tick < end) {
    if (holds_ideally(p)) state.pressure_P_Pa = source_pressure_Pa(p, input, state.time_s);
    const double tolerance = stride > 1 ? p.integration.tolerance : std::numeric_limits<double>::infinity();
    const double h = finest * static_cast<double>(stride);
    const double error = internal_step(context, state, h, tolerance, losses);
    if (!(error <= tolerance)) {
      if (stride == 1) diverged(state, h);
      stride /= 2;
      continue;
    }
    tick += stride;
    if (error < grow * p.integration.tolerance && stride < ticks_per_longest && tick % (2 * stride) == 0) stride *= 2;
  }
  if (c.solenoid_a) {
    heat_up(p.solenoid_a.heat, state.solenoid_a.heat, losses.solenoid_a.winding_J / dt_s,
            losses.solenoid_a.iron_J / dt_s, input.ambient_temperature_C, input.oil_temperature_C, dt_s);
  }
  if (c.solenoid_b) {
    heat_up(p.solenoid_b.heat, state.solenoid_b.heat, losses.solenoid_b.winding_J / dt_s,
            losses.solenoid_b.iron_J / dt_s, input.ambient_temperature_C, input.oil_temperature_C, dt_s);
  }
}

PlantOutput observe(const PlantParameters& p, const PlantState& state_now, const PlantInput& input) {
  PlantState state = state_now;
  refresh_oil(p, state, input.oil_temperature_C);
  if (holds_ideally(p)) state.pressure_P_Pa = source_pressure_Pa(p, input, state.time_s);
  const PlantConstants c = plant_constants(p, state, input);
  PlantRates r{};
  plant_rates(p, c, state, input, differential_states(state), contact_ages(state), state.time_s, r);

  PlantOutput out;
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

  const double armature_drag_N = c.armature_drag_N_s_per_m * state.velocity_m_per_s;
  const double armature_mass_kg = c.armatures * p.spool.armature_mass_kg;
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
