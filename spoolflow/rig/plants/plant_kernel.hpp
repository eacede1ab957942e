#pragma once
/// The plants of several valves in one set of SIMD registers: the same templates as one valve's. Included by the
/// translation units of the instruction sets alone.
#include <limits>

#include "spoolflow/rig/numerics/lane_functions.hpp"
#include "spoolflow/rig/plant/plant_integrator.hpp"
#include "spoolflow/rig/plant/plant_truth.hpp"
#include "spoolflow/rig/plants/plant_steps.hpp"
#include "spoolflow/rig/plants/preisach_lanes.hpp"

namespace spoolflow::rig {

template <int count>
Lanes<count> angle_of(const Lanes<count>& sine, const Lanes<count>& cosine) {
  Lanes<count> out = 0.0;
  for (std::size_t valve = 0; valve < count; ++valve) out.set(valve, std::atan2(sine[valve], cosine[valve]));
  return out;
}

/// Of aggregates that hold numbers and nothing else: one valve's into its lane, and out of it.
template <int count, class Of, class One>
void put(Of& all_valves, std::size_t valve, const One& one) {
  static_assert(sizeof(Of) == count * sizeof(One) && std::is_trivially_copyable_v<Of>);
  for (std::size_t k = 0; k < sizeof(One) / sizeof(double); ++k) {
    std::memcpy(reinterpret_cast<char*>(&all_valves) + (k * count + valve) * sizeof(double),
                reinterpret_cast<const char*>(&one) + k * sizeof(double), sizeof(double));
  }
}
template <int count, class Of, class One>
void get(const Of& all_valves, std::size_t valve, One& one) {
  static_assert(sizeof(Of) == count * sizeof(One) && std::is_trivially_copyable_v<One>);
  for (std::size_t k = 0; k < sizeof(One) / sizeof(double); ++k) {
    std::memcpy(reinterpret_cast<char*>(&one) + k * sizeof(double),
                reinterpret_cast<const char*>(&all_valves) + (k * count + valve) * sizeof(double), sizeof(double));
  }
}

/// Hands every number below an aggregate to `visit`, in the order of its description.
template <class Aggregate, class Visit>
void each_number(Aggregate& aggregate, const Visit& visit) {
  Aggregate::describe(aggregate, [&](const auto& what, auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(what)>, Parameter>) {
      visit(member);
    } else {
      each_number(member, visit);
    }
  });
}

template <int count>
struct PlantLanes {
  using Numbers = Lanes<count>;
  PlantParametersOf<Numbers> parameters;
  PlantStateOf<Numbers> state;
  const PlantParameters* alone[count];
  StrideGrid grids[count];
  Numbers longest_s;
  double period_s;

  void begin(const PlantParameters* const* all, const double* numbers, const PlantState* const* states) {
    const PlantParameters& one = *all[0];
    parameters.arrangement = one.arrangement;
    parameters.solenoid_a.hysteresis.kind = one.solenoid_a.hysteresis.kind;
    parameters.solenoid_b.hysteresis.kind = one.solenoid_b.hysteresis.kind;
    parameters.load.kind = one.load.kind;
    parameters.load.ideal_hold = one.load.ideal_hold;
    parameters.load.return_to_tank = one.load.return_to_tank;
    each_number(parameters, [&](Numbers& number) {
      for (std::size_t valve = 0; valve < count; ++valve) number.set(valve, *numbers++);
    });
    for (std::size_t valve = 0; valve < count; ++valve) {
      alone[valve] = all[valve];
      begin_solenoid(state.solenoid_a, valve, states[valve]->solenoid_a);
      begin_solenoid(state.solenoid_b, valve, states[valve]->solenoid_b);
      begin_body(valve, *states[valve]);
    }
    period_s = 0.0;
  }

  void step(const PlantInput* const* inputs, double dt_s) {
    const PlantInputOf<Numbers> input = together(inputs);
    refresh_oil(input);
    if (dt_s != period_s) plan_strides(dt_s);
    const PlantConstantsOf<Numbers> c = plant_constants(parameters, state, input);
    const ErrorScaleOf<Numbers> scale(parameters, c);
    ImposedPathOf<Numbers> path{};
    if (input.motion) {
      path = {state.position_m, state.velocity_m_per_s, input.motion->position_m, input.motion->velocity_m_per_s, dt_s};
    }
    const StepContextOf<Numbers> context{parameters, c, input, scale, input.motion ? &path : nullptr, state.time_s};
    PlantLossesOf<Numbers> losses;
    stride(context, losses);
    heat_up(parameters, c, state, losses, input, dt_s);
  }

  void show(PlantState* const* states) const {
    for (std::size_t valve = 0; valve < count; ++valve) {
      PlantState& out = *states[valve];
      out.time_s = state.time_s[valve];
      out.position_m = state.position_m[valve];
      out.velocity_m_per_s = state.velocity_m_per_s[valve];
      out.solenoid_a.flux_linkage_Wb = state.solenoid_a.flux_linkage_Wb[valve];
      out.solenoid_a.flux_Wb = state.solenoid_a.flux_Wb[valve];
      out.solenoid_b.flux_linkage_Wb = state.solenoid_b.flux_linkage_Wb[valve];
      out.solenoid_b.flux_Wb = state.solenoid_b.flux_Wb[valve];
    }
  }

  void observe(const PlantInput* const* inputs, PlantOutput* const* outputs) {
    const PlantInputOf<Numbers> input = together(inputs);
    const OilStateOf<Numbers> oil = state.oil;
    const Numbers pressure_P_Pa = state.pressure_P_Pa;
    refresh_oil(input);
    hold(input, true);
    const PlantOutputOf<Numbers> out = observed(parameters, state, input);
    for (std::size_t valve = 0; valve < count; ++valve) get<count>(out, valve, *outputs[valve]);
    state.oil = oil;
    state.pressure_P_Pa = pressure_P_Pa;
  }

 private:
  void begin_solenoid(SolenoidStateOf<Numbers>& to, std::size_t valve, const SolenoidState& from) {
    to.flux_linkage_Wb.set(valve, from.flux_linkage_Wb);
    to.flux_Wb.set(valve, from.flux_Wb);
    to.skin_current_A.set(valve, from.skin_current_A);
    to.iron.flux_density_T.set(valve, from.iron.flux_density_T);
    to.iron.field_A_per_m.set(valve, from.iron.field_A_per_m);
    put<count>(to.iron.jiles_atherton, valve, from.iron.jiles_atherton);
    put<count>(to.heat, valve, from.heat);
    put<count>(to.friction, valve, from.friction);
    const PreisachMemory& memory = from.iron.preisach;
    PreisachMemoryOf<Numbers>& of_all = to.iron.preisach;
    set_valve(of_all.now, valve, memory.now);
    of_all.slope_m_per_H.set(valve, memory.slope_m_per_H);
    put<count>(of_all.foot, valve, memory.foot);
    of_all.count.set(valve, static_cast<double>(memory.count));
    of_all.reversals[valve] = memory.reversals;
    if (memory.count > 0) set_valve(of_all.last, valve, memory.reversals[memory.count - 1]);
    if (memory.count > 1) set_valve(of_all.before, valve, memory.reversals[memory.count - 2]);
  }

  void begin_body(std::size_t valve, const PlantState& from) {
    state.time_s.set(valve, from.time_s);
    state.position_m.set(valve, from.position_m);
    state.velocity_m_per_s.set(valve, from.velocity_m_per_s);
    put<count>(state.spool_friction, valve, from.spool_friction);
    put<count>(state.oil, valve, from.oil);
    state.pressure_P_Pa.set(valve, from.pressure_P_Pa);
    state.pressure_A_Pa.set(valve, from.pressure_A_Pa);
    state.pressure_B_Pa.set(valve, from.pressure_B_Pa);
    state.hold_flow_m3_per_s.set(valve, from.hold_flow_m3_per_s);
    state.cylinder_position_m.set(valve, from.cylinder_position_m);
    state.cylinder_velocity_m_per_s.set(valve, from.cylinder_velocity_m_per_s);
  }

  PlantInputOf<Numbers> together(const PlantInput* const* inputs) const {
    PlantInputOf<Numbers> out;
    const bool moved = inputs[0]->motion.has_value();
    if (moved) out.motion.emplace();
    for (std::size_t valve = 0; valve < count; ++valve) {
      const PlantInput& input = *inputs[valve];
      out.voltage_a_V.set(valve, input.voltage_a_V);
      out.voltage_b_V.set(valve, input.voltage_b_V);
      out.supply_pressure_Pa.set(valve, input.supply_pressure_Pa);
      out.held_pressure_difference_Pa.set(valve, input.held_pressure_difference_Pa);
      out.load_force_N.set(valve, input.load_force_N);
      out.foreign_force_N.set(valve, input.foreign_force_N);
      out.oil_temperature_C.set(valve, input.oil_temperature_C);
      out.ambient_temperature_C.set(valve, input.ambient_temperature_C);
      if (moved) put<count>(*out.motion, valve, *input.motion);
    }
    return out;
  }

  void refresh_oil(const PlantInputOf<Numbers>& input) {
    if (!any(state.oil.temperature_C != input.oil_temperature_C || state.oil.density_kg_per_m3 == 0.0)) return;
    for (std::size_t valve = 0; valve < count; ++valve) {
      OilState oil;
      get<count>(state.oil, valve, oil);
      put<count>(state.oil, valve, oil_of(*alone[valve], oil, input.oil_temperature_C[valve]));
    }
  }

  /// Of valves that have arrived the pressure is that of their last step.
  void hold(const PlantInputOf<Numbers>& input, const LaneMask<count>& moving) {
    if (!holds_ideally(alone[0]->load)) return;
    const auto boundary = hydraulic_boundary(parameters.supply, parameters.load, input.supply_pressure_Pa,
                                             input.held_pressure_difference_Pa, input.load_force_N, state.time_s);
    take(moving, state.pressure_P_Pa, boundary.source_pressure_Pa);
  }

  void plan_strides(double dt_s) {
    for (std::size_t valve = 0; valve < count; ++valve) {
      grids[valve] = stride_grid(alone[valve]->integration, dt_s);
      longest_s.set(valve, grids[valve].finest_s * static_cast<double>(grids[valve].ticks_per_longest));
    }
    period_s = dt_s;
  }

  /// Each valve in its own strides; those that have arrived wait.
  void stride(const StepContextOf<Numbers>& context, PlantLossesOf<Numbers>& losses) {
    constexpr double grow = 1.0 / 16.0;  // of the tolerance: doubling multiplies the estimate by about eight
    constexpr double any_error = std::numeric_limits<double>::infinity();
    std::int64_t tick[count], stride[count];
    Numbers h = longest_s;
    Numbers tolerance = parameters.integration.tolerance;
    LaneMask<count> moving = true;
    for (std::size_t valve = 0; valve < count; ++valve) {
      tick[valve] = 0;
      stride[valve] = grids[valve].ticks_per_longest;
      if (stride[valve] == 1) tolerance.set(valve, any_error);
    }
    while (any(moving)) {
      hold(context.input, moving);
      const Numbers error = internal_step(context, state, h, tolerance, losses, moving);
      for (std::size_t valve = 0; valve < count; ++valve) {
        if (!moving[valve]) continue;
        const double allowed = parameters.integration.tolerance[valve];
        if (!(error[valve] <= tolerance[valve])) {
          if (stride[valve] == 1) report(valve, h[valve]);
          stride[valve] /= 2;
        } else {
          tick[valve] += stride[valve];
          if (error[valve] < grow * allowed && stride[valve] < grids[valve].ticks_per_longest &&
              tick[valve] % (2 * stride[valve]) == 0) {
            stride[valve] *= 2;
          }
          if (tick[valve] >= grids[valve].end) moving.bits[valve] = 0;
        }
        h.set(valve, grids[valve].finest_s * static_cast<double>(stride[valve]));
        tolerance.set(valve, stride[valve] > 1 ? allowed : any_error);
      }
    }
  }

  [[noreturn]] void report(std::size_t valve, double h) const {
    PlantState at;
    at.time_s = state.time_s[valve];
    at.position_m = state.position_m[valve];
    at.velocity_m_per_s = state.velocity_m_per_s[valve];
    at.pressure_P_Pa = state.pressure_P_Pa[valve];
    diverged(at, h);
  }
};

template <int count>
constexpr PlantSteps plant_steps_of() {
  using Plants = PlantLanes<count>;
  return {
      .valves = count,
      .bytes = sizeof(Plants),
      .alignment = alignof(Plants),
      .begin = [](void* memory, const PlantParameters* const* parameters, const double* numbers,
                  const PlantState* const* states) { (new (memory) Plants)->begin(parameters, numbers, states); },
      .step = [](void* memory, const PlantInput* const* inputs,
                 double dt_s) { static_cast<Plants*>(memory)->step(inputs, dt_s); },
      .show = [](const void* memory, PlantState* const* states) { static_cast<const Plants*>(memory)->show(states); },
      .observe = [](void* memory, const PlantInput* const* inputs,
                    PlantOutput* const* outputs) { static_cast<Plants*>(memory)->observe(inputs, outputs); }};
}

}  // namespace spoolflow::rig
