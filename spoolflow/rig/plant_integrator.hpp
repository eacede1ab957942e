#pragma once
/// One internal step of the plant: ROS2 (Verwer, Spee, Blom, Hundsdorfer 1999) with gamma = 1 - 1/sqrt(2),
///
///     (1 - g h A) k1 = f(t, u),   (1 - g h A) k2 = f(t + h, u + h k1) - 2 k1,   u <- u + 3/2 h k1 + 1/2 h k2
///
/// Second order for any matrix A (a W-method) and L-stable where A is the Jacobian. So A holds what is stiff, block by
/// block: each solenoid (3 states), the body's contacts and drag (2), the volumes with the cylinder (5); what couples
/// the blocks is slow against a step and enters explicitly. Two evaluations a step, no iteration, no allocation,
/// constant time.
#include <numbers>

#include "spoolflow/rig/plant_dynamics.hpp"

namespace spoolflow::rig {

/// The body's pair of states: (1 - w J) k = r with contact stiffness and damping.
struct BodySolver {
  double weight_s, stiffness_per_s2, pivot;

  BodySolver(const PlantConstants& constants, const PlantRates& point, double w) : weight_s(w) {
    double flow_damping = 0.0;
    if (constants.hydraulics) {
      for (std::size_t i = 0; i < 4; ++i) {
        flow_damping -= constants.density_kg_per_m3 * constants.edges[i]->damping_length_m *
                        point.hydraulics.edges[i].flow_gain_m2_per_s;
      }
    }
    const double stiffness = point.spring.stiffness_N_per_m + point.spool_friction.stiffness_N_per_m +
                             point.armature_a_friction.stiffness_N_per_m + point.armature_b_friction.stiffness_N_per_m +
                             point.end_stop.stiffness_N_per_m;
    const double damping = constants.spool_drag_N_s_per_m + constants.armature_drag_N_s_per_m +
                           point.end_stop.damping_N_s_per_m + std::max(0.0, flow_damping);
    stiffness_per_s2 = stiffness / constants.mass_kg;
    pivot = 1.0 / (1.0 + w * (damping / constants.mass_kg + w * stiffness_per_s2));
  }

  /// {k_x, k_v} for {r_x, r_v}.
  std::array<double, 2> operator()(double r_x, double r_v) const {
    const double k_v = (r_v - weight_s * stiffness_per_s2 * r_x) * pivot;
    return {r_x + weight_s * k_v, k_v};
  }
};

/// Position and velocity an external drive imposes at a time after the call's start.
struct ImposedPath {
  double start_m, start_m_per_s, end_m, end_m_per_s, duration_s;

  [[nodiscard]] std::array<double, 2> at(double time_s) const {
    const double s = time_s / duration_s;
    const double chord = (end_m - start_m) / duration_s;
    const double a = start_m_per_s - chord;
    const double b = end_m_per_s - chord;
    // Cubic through both ends: chord plus s (1 - s) [a (1 - s) - b s].
    return {start_m + duration_s * s * (chord + (1.0 - s) * (a * (1.0 - s) - b * s)),
            chord + a * (1.0 - s) * (1.0 - 3.0 * s) + b * s * (3.0 * s - 2.0)};
  }
};

/// Losses of a solenoid summed over the internal steps [J].
struct SolenoidLosses {
  double winding_J = 0.0;
  double iron_J = 0.0;
};

inline void add_losses(const Solenoid& solenoid, const SolenoidConstants& constants, const SolenoidState& state,
                       const SolenoidRates& rates, double flux_change_Wb, double h, SolenoidLosses& losses) {
  const double area = solenoid.circuit.iron_area_m2;
  const double skin = rates.eddy_current_A - state.skin_current_A;
  losses.winding_J += h * constants.resistance_ohm * rates.current_A * rates.current_A;
  losses.iron_J += h * (solenoid.eddy.core_resistance_ohm * rates.eddy_current_A * rates.eddy_current_A +
                        solenoid.eddy.skin_resistance_ohm * skin * skin) +
                   area * solenoid.circuit.iron_length_m *
                       hysteresis_loss(solenoid.hysteresis, state.hysteresis_A_per_m, flux_change_Wb / area);
}

template <std::size_t size>
std::array<double, size> combined(const std::array<double, size>& u, double f1, const std::array<double, size>& k1,
                                  double f2, const std::array<double, size>& k2) {
  std::array<double, size> sum;
  for (std::size_t i = 0; i < size; ++i) sum[i] = u[i] + f1 * k1[i] + f2 * k2[i];
  return sum;
}

inline void commit(const Solenoid& solenoid, SolenoidState& state, const SolenoidVector& states) {
  state.hysteresis_A_per_m = advanced(solenoid.hysteresis, state.hysteresis_A_per_m,
                                      (states[1] - state.flux_Wb) / solenoid.circuit.iron_area_m2);
  state.flux_linkage_Wb = states[0];
  state.flux_Wb = states[1];
  state.skin_current_A = states[2];
}

inline void commit(PlantState& state, const HydraulicVector& states) {
  state.pressure_P_Pa = std::max(states[0], cavitation_pressure_Pa);
  state.pressure_A_Pa = std::max(states[1], cavitation_pressure_Pa);
  state.pressure_B_Pa = std::max(states[2], cavitation_pressure_Pa);
  state.hold_flow_m3_per_s = states[3];
  state.cylinder_position_m = states[4];
  state.cylinder_velocity_m_per_s = states[5];
}

inline void internal_step(const PlantParameters& p, const PlantConstants& c, PlantState& state, const PlantInput& input,
                          const ImposedPath* path, double path_time_s, double h, SolenoidLosses& losses_a,
                          SolenoidLosses& losses_b) {
  constexpr double gamma = 1.0 - 0.5 * std::numbers::sqrt2;
  const double w = gamma * h;
  const PlantVector u0 = differential_states(state);
  const ContactAges ages0{state.spool_friction.age, state.solenoid_a.friction.age, state.solenoid_b.friction.age};
  const PlantRates r0 = plant_rates(p, c, state, input, u0, ages0, state.time_s);

  PlantVector u1 = u0;
  PlantVector u2 = u0;
  const BodySolver body(c, r0, w);
  const auto [k1_x, k1_v] = body(u0.velocity_m_per_s, r0.acceleration_m_per_s2);
  if (path != nullptr) {
    const auto [x, v] = path->at(path_time_s + h);
    u1.position_m = u2.position_m = x;
    u1.velocity_m_per_s = u2.velocity_m_per_s = v;
  } else {
    u1.position_m += h * k1_x;
    u1.velocity_m_per_s += h * k1_v;
  }
  const std::array<double, 3> none{};
  const std::array<double, 6> none6{};
  SolenoidVector k1_a{}, k1_b{};
  HydraulicVector k1_h{};
  const SolenoidSolver solver_a =
      c.solenoid_a ? SolenoidSolver(c.solenoid_a_constants, r0.solenoid_a, w) : SolenoidSolver();
  const SolenoidSolver solver_b =
      c.solenoid_b ? SolenoidSolver(c.solenoid_b_constants, r0.solenoid_b, w) : SolenoidSolver();
  const HydraulicSolver solver_h =
      c.hydraulics ? HydraulicSolver(p.supply, p.load, r0.hydraulics, w) : HydraulicSolver();
  if (c.solenoid_a) {
    k1_a = solver_a(r0.solenoid_a.rate);
    u1.solenoid_a = combined(u0.solenoid_a, h, k1_a, 0.0, none);
  }
  if (c.solenoid_b) {
    k1_b = solver_b(r0.solenoid_b.rate);
    u1.solenoid_b = combined(u0.solenoid_b, h, k1_b, 0.0, none);
  }
  if (c.hydraulics) {
    k1_h = solver_h(r0.hydraulics.rate);
    u1.hydraulics = combined(u0.hydraulics, h, k1_h, 0.0, none6);
  }

  const double speed = 0.5 * std::abs(u0.velocity_m_per_s + u1.velocity_m_per_s);
  const ContactAges ages1{aged(p.spool_friction, ages0.spool, speed, h),
                          aged(p.solenoid_a.friction, ages0.armature_a, speed, h),
                          aged(p.solenoid_b.friction, ages0.armature_b, speed, h)};
  const PlantRates r1 = plant_rates(p, c, state, input, u1, ages1, state.time_s + h);

  if (path == nullptr) {
    const auto [k2_x, k2_v] = body(u1.velocity_m_per_s - 2.0 * k1_x, r1.acceleration_m_per_s2 - 2.0 * k1_v);
    u2.position_m += h * (1.5 * k1_x + 0.5 * k2_x);
    u2.velocity_m_per_s += h * (1.5 * k1_v + 0.5 * k2_v);
  }
  if (c.solenoid_a) {
    const SolenoidVector k2 = solver_a(combined(r1.solenoid_a.rate, -2.0, k1_a, 0.0, none));
    u2.solenoid_a = combined(u0.solenoid_a, 1.5 * h, k1_a, 0.5 * h, k2);
  }
  if (c.solenoid_b) {
    const SolenoidVector k2 = solver_b(combined(r1.solenoid_b.rate, -2.0, k1_b, 0.0, none));
    u2.solenoid_b = combined(u0.solenoid_b, 1.5 * h, k1_b, 0.5 * h, k2);
  }
  if (c.hydraulics) {
    const HydraulicVector k2 = solver_h(combined(r1.hydraulics.rate, -2.0, k1_h, 0.0, none6));
    u2.hydraulics = combined(u0.hydraulics, 1.5 * h, k1_h, 0.5 * h, k2);
  }

  const double displacement = u2.position_m - u0.position_m;
  if (c.solenoid_a) {
    add_losses(p.solenoid_a, c.solenoid_a_constants, state.solenoid_a, r0.solenoid_a,
               u2.solenoid_a[1] - u0.solenoid_a[1], h, losses_a);
    commit(p.solenoid_a, state.solenoid_a, u2.solenoid_a);
    slide(p.solenoid_a.friction, state.solenoid_a.friction, displacement, r1.armature_a_breakaway_N);
    state.solenoid_a.friction.age = ages1.armature_a;
  }
  if (c.solenoid_b) {
    add_losses(p.solenoid_b, c.solenoid_b_constants, state.solenoid_b, r0.solenoid_b,
               u2.solenoid_b[1] - u0.solenoid_b[1], h, losses_b);
    commit(p.solenoid_b, state.solenoid_b, u2.solenoid_b);
    slide(p.solenoid_b.friction, state.solenoid_b.friction, displacement, r1.armature_b_breakaway_N);
    state.solenoid_b.friction.age = ages1.armature_b;
  }
  if (c.hydraulics) {
    slide(p.spool_friction, state.spool_friction, displacement, r1.spool_breakaway_N);
    state.spool_friction.age = ages1.spool;
    commit(state, u2.hydraulics);
  }
  state.position_m = u2.position_m;
  state.velocity_m_per_s = u2.velocity_m_per_s;
  state.time_s += h;
}

}  // namespace spoolflow::rig
