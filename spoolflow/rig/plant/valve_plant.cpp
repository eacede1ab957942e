#include "spoolflow/rig/plant/valve_plant.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "spoolflow/rig/plant/plant_integrator.hpp"
#include "spoolflow/rig/plant/plant_truth.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

void refresh_oil(const PlantParameters& parameters, PlantState& state, double temperature_C) {
  state.oil = oil_of(parameters, state.oil, temperature_C);
}

double source_pressure_Pa(const PlantParameters& p, const PlantInput& input, double time_s) {
  return hydraulic_boundary(p.supply, p.load, input.supply_pressure_Pa, input.held_pressure_difference_Pa,
                            input.load_force_N, time_s)
      .source_pressure_Pa;
}

}  // namespace

OilState oil_of(const PlantParameters& parameters, const OilState& kept, double temperature_C) {
  const bool made = kept.temperature_C == temperature_C && kept.density_kg_per_m3 != 0.0;
  return made ? kept : oil_at(parameters.oil, temperature_C);
}

bool holds_ideally(const Load& load) {
  return load.ideal_hold && (load.kind == LoadKind::held_difference || load.kind == LoadKind::held_path);
}

void diverged(const PlantState& state, double h) {
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

StrideGrid stride_grid(const Integration& integration, double dt_s) {
  const double count = std::max(1.0, std::ceil(dt_s / integration.longest_step_s - 1e-6));
  StrideGrid grid{.finest_s = dt_s / count, .ticks_per_longest = 1, .end = 0};
  while (grid.ticks_per_longest < 1 << 20 && 0.5 * grid.finest_s >= integration.shortest_step_s) {
    grid.finest_s *= 0.5;
    grid.ticks_per_longest *= 2;
  }
  grid.end = static_cast<std::int64_t>(count) * grid.ticks_per_longest;
  return grid;
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

  constexpr double grow = 1.0 / 16.0;  // of the tolerance: doubling multiplies the estimate by about eight
  const auto [finest, ticks_per_longest, end] = stride_grid(p.integration, dt_s);
  std::int64_t tick = 0;
  std::int64_t stride = ticks_per_longest;
  while (tick < end) {
    if (holds_ideally(p.load)) state.pressure_P_Pa = source_pressure_Pa(p, input, state.time_s);
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
  heat_up(p, c, state, losses, input, dt_s);
}

PlantOutput observe(const PlantParameters& p, const PlantState& state_now, const PlantInput& input) {
  PlantState state = state_now;
  refresh_oil(p, state, input.oil_temperature_C);
  if (holds_ideally(p.load)) state.pressure_P_Pa = source_pressure_Pa(p, input, state.time_s);
  return observed(p, state, input);
}

}  // namespace spoolflow::rig
