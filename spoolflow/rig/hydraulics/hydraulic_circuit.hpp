#pragma once
/// Pressures and flows round the valve's four edges, for each kind of load, and the Jacobian their integrator needs.
///
///     C_P dp_P/dt = G (p_set - p_P) + Q_i - Q_PA - Q_PB                                  (supply.hpp)
///     C_A dp_A/dt = Q_PA - Q_AT + Q_L + A_A v_c,   C_B dp_B/dt = Q_PB - Q_BT - Q_L - A_B v_c
///     m dv_c/dt   = p_B A_B - p_A A_A - d v_c - F_cushion - F_ext,   Q_L from B to A: orifice or piston leakage
///     C = V/K_eff(p)
///
/// A motor is a cylinder whose areas are its displacement, with turns and torques for ways and forces, and no end.
/// Where the load returns straight to tank, dp_A/dt = 0 and p_A is the tank's. With the held difference, A, B and T all
/// drain to the back pressure. With the held path, A and B are one volume, C dp_AB/dt = Q_PA + Q_PB - Q_AT - Q_BT; with
/// the held return, the source feeds A, and P, B and T are at the back pressure. Below the cavitation pressure a volume
/// stays there.
#include <algorithm>
#include <array>
#include <span>

#include "spoolflow/rig/hydraulics/flow_force.hpp"
#include "spoolflow/rig/hydraulics/load.hpp"
#include "spoolflow/rig/hydraulics/metering_edge.hpp"
#include "spoolflow/rig/hydraulics/oil.hpp"
#include "spoolflow/rig/hydraulics/supply.hpp"

namespace spoolflow::rig {

/// Differential states, in this order.
enum HydraulicIndex { state_p_P, state_p_A, state_p_B, state_Q_i, state_x_c, state_v_c, hydraulic_states };
template <class Scalar>
using HydraulicVectorOf = Given<std::span<const Scalar, hydraulic_states>>;
template <class Scalar>
using HydraulicRateOf = Given<std::span<Scalar, hydraulic_states>>;

enum EdgeIndex { edge_PA, edge_PB, edge_AT, edge_BT };
/// +1: opens with x > 0.
inline constexpr std::array<double, 4> edge_side{-1.0, 1.0, 1.0, -1.0};

/// What surrounds the valve during one step.
template <class Scalar>
struct HydraulicBoundaryOf {
  Scalar source_pressure_Pa;  ///< set value with the ripple
  Scalar tank_pressure_Pa;
  Scalar load_force_N;
};

/// A wave of period and amplitude 1 out of parabolas, sign and zeros of the sine, within 6 % of it, with a steady
/// slope.
template <class Scalar>
inline Scalar parabolic_wave(Scalar periods) {
  const Scalar phase = periods - nearest_whole(periods);
  return 16.0 * phase * (0.5 - magnitude(phase));
}

template <class Scalar>
inline HydraulicBoundaryOf<Scalar> hydraulic_boundary(const SupplyOf<Scalar>& supply, const LoadOf<Scalar>& load,
                                                      Scalar supply_pressure_Pa, Scalar held_difference_Pa,
                                                      Scalar load_force_N, Scalar time_s) {
  const bool held = holds_difference(load.kind);
  return {.source_pressure_Pa = (held ? supply.back_pressure_Pa + held_difference_Pa : supply_pressure_Pa) +
                                supply.ripple_Pa * parabolic_wave(supply.ripple_Hz * time_s),
          .tank_pressure_Pa = held ? supply.back_pressure_Pa : supply.tank_pressure_Pa,
          .load_force_N = load_force_N};
}

template <class Scalar>
struct LoadFlowOf {
  Scalar flow_m3_per_s;  ///< from B to A
  Scalar conductance_m3_per_s_Pa;
};

/// What the pressures move: a piston, or the shaft of a motor in turns [rad] and torques [N m].
template <class Scalar>
struct MovedLoadOf {
  bool moves;
  Scalar area_A, area_B;  ///< [m2], or displacement [m3/rad]
  Scalar mass;            ///< [kg], or inertia [kg m2]
  Scalar drag;            ///< [N s/m], or [N m s]
  Scalar leakage_m3_per_s_Pa;
  Scalar force;  ///< against moving under flow from B [N], or [N m]
};

template <class Scalar>
inline MovedLoadOf<Scalar> moved_load(const LoadOf<Scalar>& load, Scalar load_force_N) {
  switch (load.kind) {
    case LoadKind::cylinder:
      return {true,
              load.piston_area_A_m2,
              load.piston_area_B_m2,
              load.cylinder_mass_kg,
              load.cylinder_drag_N_s_per_m,
              load.cylinder_leakage_m3_per_s_Pa,
              load_force_N};
    case LoadKind::motor:
      return {true,
              load.motor_displacement_m3_per_rad,
              load.motor_displacement_m3_per_rad,
              load.motor_inertia_kg_m2,
              load.motor_drag_N_m_s,
              load.motor_leakage_m3_per_s_Pa,
              load.motor_torque_N_m};
    case LoadKind::held_difference:
    case LoadKind::held_path:
    case LoadKind::held_return:
    case LoadKind::orifice:
      break;
  }
  return {false, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
}

/// Fixed orifice: turbulent, laminar below 0.1 bar; or leakage past piston or motor.
template <class Scalar>
inline LoadFlowOf<Scalar> load_flow(const LoadOf<Scalar>& load, Scalar density_kg_per_m3,
                                    Scalar pressure_difference_Pa) {
  if (const MovedLoadOf<Scalar> moved = moved_load(load, Scalar(0.0)); moved.moves) {
    return {moved.leakage_m3_per_s_Pa * pressure_difference_Pa, moved.leakage_m3_per_s_Pa};
  }
  constexpr double laminar_Pa = 1e4;
  constexpr double discharge = 0.7;
  const Scalar gain = discharge * load.orifice_area_m2 * square_root(2.0 / density_kg_per_m3);
  const Scalar square = pressure_difference_Pa * pressure_difference_Pa + laminar_Pa * laminar_Pa;
  const Scalar root = square_root(square_root(square));
  return {gain * pressure_difference_Pa / root,
          gain / root * (1.0 - 0.5 * pressure_difference_Pa * pressure_difference_Pa / square)};
}

template <class Scalar>
struct CushionOf {
  Scalar force_N;
  Scalar stiffness_N_per_m;
  Scalar damping_N_s_per_m;
};

/// End cushions of the cylinder, against moving further out of its stroke.
template <class Scalar>
inline CushionOf<Scalar> cushion_force(const LoadOf<Scalar>& load, Scalar position_m, Scalar velocity_m_per_s) {
  constexpr double stiffness_N_per_m = 5e7;
  constexpr double damping_s_per_m = 2.0;
  const Scalar depth = magnitude(position_m) - 0.5 * load.cylinder_stroke_m;
  const Mask<Scalar> touches = !(depth <= 0.0);
  if (!any(touches)) return {0.0, 0.0, 0.0};
  const Scalar side = select(position_m > 0.0, Scalar(1.0), Scalar(-1.0));
  const Scalar push = stiffness_N_per_m * depth * larger(Scalar(0.0), 1.0 + damping_s_per_m * side * velocity_m_per_s);
  return {select(touches, side * push, Scalar(0.0)), select(touches, Scalar(stiffness_N_per_m), Scalar(0.0)),
          select(touches, stiffness_N_per_m * depth * damping_s_per_m, Scalar(0.0))};
}

/// Left uninitialised where it is made: hydraulic_rates fills every member.
template <class Scalar>
struct HydraulicRatesOf {
  std::array<EdgeFlowOf<Scalar>, 4> edges;
  std::array<Scalar, 4> difference_Pa;
  std::array<Scalar, 4> difference_rate_Pa_per_s;
  LoadFlowOf<Scalar> load;
  CushionOf<Scalar> cushion;
  Scalar elastance_P, elastance_A, elastance_B;  ///< 1/C [Pa/m3]
};

/// Source and volumes of the benches that hold a difference over the valve; `error_Pa` of the source's pressure.
template <class Scalar>
inline void held_rates(const SupplyOf<Scalar>& supply, const LoadOf<Scalar>& load, const OilOf<Scalar>& oil,
                       const OilStateOf<Scalar>& oil_state, Scalar error_Pa, HydraulicVectorOf<Scalar> states,
                       HydraulicRatesOf<Scalar>& out, HydraulicRateOf<Scalar> rate) {
  const Scalar G = supply.source_conductance_m3_per_s_Pa;
  const Scalar Q_PA = out.edges[edge_PA].flow_m3_per_s, Q_PB = out.edges[edge_PB].flow_m3_per_s;
  const Scalar Q_AT = out.edges[edge_AT].flow_m3_per_s, Q_BT = out.edges[edge_BT].flow_m3_per_s;
  rate[state_Q_i] = G / supply.hold_integral_time_s * error_Pa;
  if (load.kind == LoadKind::held_return) {
    out.elastance_A = 1.0 / (supply.line_volume_m3 * compressibility_per_Pa(oil, oil_state, states[state_p_A]));
    rate[state_p_A] = out.elastance_A * (G * error_Pa + states[state_Q_i] + Q_PA - Q_AT);
    return;
  }
  rate[state_p_P] = out.elastance_P * (G * error_Pa + states[state_Q_i] - Q_PA - Q_PB);
  if (load.ideal_hold) rate[state_p_P] = rate[state_Q_i] = 0.0;
  if (load.kind == LoadKind::held_path) {
    out.elastance_A = 1.0 / (2.0 * load.port_volume_m3 * compressibility_per_Pa(oil, oil_state, states[state_p_A]));
    rate[state_p_A] = rate[state_p_B] = out.elastance_A * (Q_PA + Q_PB - Q_AT - Q_BT);
  }
}

template <class Scalar>
inline void hydraulic_rates(const std::array<const MeteringEdgeOf<Scalar>*, 4>& edges,
                            const std::array<EdgeConstantsOf<Scalar>, 4>& constants, const SupplyOf<Scalar>& supply,
                            const LoadOf<Scalar>& load, const OilOf<Scalar>& oil, const OilStateOf<Scalar>& oil_state,
                            Scalar density_kg_per_m3, const HydraulicBoundaryOf<Scalar>& boundary,
                            HydraulicVectorOf<Scalar> states, Scalar position_m, HydraulicRatesOf<Scalar>& out,
                            HydraulicRateOf<Scalar> rate) {
  const Scalar p_P = states[state_p_P], p_A = states[state_p_A], p_B = states[state_p_B];
  const Scalar x_c = states[state_x_c], v_c = states[state_v_c];
  const Scalar p_T = boundary.tank_pressure_Pa;
  out.difference_Pa = {p_P - p_A, p_P - p_B, p_A - p_T, p_B - p_T};
  for (std::size_t i = 0; i < 4; ++i) {
    out.edges[i] = edge_flow(*edges[i], constants[i], edge_side[i] * position_m, out.difference_Pa[i]);
  }
  const Scalar error = boundary.source_pressure_Pa - (load.kind == LoadKind::held_return ? p_A : p_P);
  const Scalar G = supply.source_conductance_m3_per_s_Pa;
  out.elastance_P = 1.0 / (supply.line_volume_m3 * compressibility_per_Pa(oil, oil_state, p_P));
  std::fill(rate.begin(), rate.end(), Scalar(0.0));
  out.load = {0.0, 0.0};
  out.cushion = {0.0, 0.0, 0.0};
  out.elastance_A = out.elastance_B = 0.0;
  if (holds_difference(load.kind)) {
    held_rates(supply, load, oil, oil_state, error, states, out, rate);
  } else {
    rate[state_p_P] = out.elastance_P * (G * error + states[state_Q_i] - out.edges[edge_PA].flow_m3_per_s -
                                         out.edges[edge_PB].flow_m3_per_s);
    out.load = load_flow(load, density_kg_per_m3, p_B - p_A);
    const bool cylinder = load.kind == LoadKind::cylinder;
    const Scalar half = 0.5 * load.cylinder_stroke_m;
    const Scalar swept_A = cylinder ? load.piston_area_A_m2 * larger(Scalar(0.0), half - x_c) : Scalar(0.0);
    const Scalar swept_B = cylinder ? load.piston_area_B_m2 * larger(Scalar(0.0), half + x_c) : Scalar(0.0);
    out.elastance_A = 1.0 / ((load.port_volume_m3 + swept_A) * compressibility_per_Pa(oil, oil_state, p_A));
    out.elastance_B = 1.0 / ((load.port_volume_m3 + swept_B) * compressibility_per_Pa(oil, oil_state, p_B));
    Scalar into_A = out.edges[edge_PA].flow_m3_per_s - out.edges[edge_AT].flow_m3_per_s + out.load.flow_m3_per_s;
    Scalar into_B = out.edges[edge_PB].flow_m3_per_s - out.edges[edge_BT].flow_m3_per_s - out.load.flow_m3_per_s;
    if (load.return_to_tank) out.elastance_A = 0.0;
    if (const MovedLoadOf<Scalar> moved = moved_load(load, boundary.load_force_N); moved.moves) {
      into_A += moved.area_A * v_c;
      into_B -= moved.area_B * v_c;
      if (cylinder) out.cushion = cushion_force(load, x_c, v_c);
      rate[state_x_c] = v_c;
      rate[state_v_c] =
          (p_B * moved.area_B - p_A * moved.area_A - moved.drag * v_c - out.cushion.force_N - moved.force) / moved.mass;
    }
    rate[state_p_A] = out.elastance_A * into_A;
    rate[state_p_B] = out.elastance_B * into_B;
  }
  out.difference_rate_Pa_per_s = {rate[state_p_P] - rate[state_p_A], rate[state_p_P] - rate[state_p_B], rate[state_p_A],
                                  rate[state_p_B]};
}

/// Solves (1 - w J) k = r; the source's integrator enters explicitly (it is slow by its range).
template <class Scalar>
class HydraulicSolver {
 public:
  HydraulicSolver() = default;
  HydraulicSolver(const SupplyOf<Scalar>& supply, const LoadOf<Scalar>& load, const HydraulicRatesOf<Scalar>& point,
                  Scalar weight_s)
      : kind_(load.kind), weight_s_(weight_s) {
    const Scalar g_PA = point.edges[edge_PA].conductance_m3_per_s_Pa;
    const Scalar g_PB = point.edges[edge_PB].conductance_m3_per_s_Pa;
    const Scalar G = supply.source_conductance_m3_per_s_Pa;
    const Scalar wP = weight_s * point.elastance_P;
    const Scalar diagonal = 1.0 + wP * (G + g_PA + g_PB);
    if (kind_ == LoadKind::held_difference) {
      pivot_[0] = 1.0 / diagonal;
      return;
    }
    if (kind_ == LoadKind::held_return) {
      pivot_[0] =
          1.0 / (1.0 + weight_s * point.elastance_A * (G + g_PA + point.edges[edge_AT].conductance_m3_per_s_Pa));
      return;
    }
    if (kind_ == LoadKind::held_path) {  // two unknowns, the source and the joined ports
      const Scalar wJ = weight_s * point.elastance_A;
      const Scalar g_P = load.ideal_hold ? Scalar(0.0) : g_PA + g_PB;
      const Scalar g_T = point.edges[edge_AT].conductance_m3_per_s_Pa + point.edges[edge_BT].conductance_m3_per_s_Pa;
      pivot_[0] = 1.0 / diagonal;
      m_[0][1] = -wP * g_P;
      m_[1][0] = -wJ * (g_PA + g_PB) * pivot_[0];
      pivot_[1] = 1.0 / (1.0 + wJ * (g_PA + g_PB + g_T) - m_[1][0] * m_[0][1]);
      return;
    }
    const Scalar wA = weight_s * point.elastance_A;
    const Scalar wB = weight_s * point.elastance_B;
    const Scalar g_L = point.load.conductance_m3_per_s_Pa;
    const Scalar g_A = g_PA + point.edges[edge_AT].conductance_m3_per_s_Pa + g_L;
    const Scalar g_B = g_PB + point.edges[edge_BT].conductance_m3_per_s_Pa + g_L;
    m_ = {{{diagonal, -wP * g_PA, -wP * g_PB, 0.0},
           {-wA * g_PA, 1.0 + wA * g_A, -wA * g_L, 0.0},
           {-wB * g_PB, -wB * g_L, 1.0 + wB * g_B, 0.0},
           {0.0, 0.0, 0.0, 1.0}}};
    if (const MovedLoadOf<Scalar> moved = moved_load(load, Scalar(0.0)); moved.moves) {
      const Scalar w_m = weight_s / moved.mass;
      m_[1][3] = -wA * moved.area_A;
      m_[2][3] = wB * moved.area_B;
      m_[3][1] = w_m * moved.area_A;
      m_[3][2] = -w_m * moved.area_B;
      position_ = w_m * point.cushion.stiffness_N_per_m;
      m_[3][3] = 1.0 + w_m * (moved.drag + point.cushion.damping_N_s_per_m) + weight_s * position_;
    }
    for (std::size_t k = 0; k < 4; ++k) {  // no pivoting: pressures are an M-matrix, the cylinder couples skew to them
      pivot_[k] = 1.0 / m_[k][k];
      for (std::size_t i = k + 1; i < 4; ++i) {
        m_[i][k] *= pivot_[k];
        for (std::size_t j = k + 1; j < 4; ++j) m_[i][j] -= m_[i][k] * m_[k][j];
      }
    }
  }

  void operator()(HydraulicVectorOf<Scalar> right, HydraulicRateOf<Scalar> k) const {
    if (holds_difference(kind_)) {
      std::fill(k.begin(), k.end(), Scalar(0.0));
      k[state_Q_i] = right[state_Q_i];
      if (kind_ == LoadKind::held_return) {
        k[state_p_A] = right[state_p_A] * pivot_[0];
      } else if (kind_ == LoadKind::held_path) {
        k[state_p_A] = k[state_p_B] = (right[state_p_A] - m_[1][0] * right[state_p_P]) * pivot_[1];
        k[state_p_P] = (right[state_p_P] - m_[0][1] * k[state_p_A]) * pivot_[0];
      } else {
        k[state_p_P] = right[state_p_P] * pivot_[0];
      }
      return;
    }
    std::array<Scalar, 4> r{right[state_p_P], right[state_p_A], right[state_p_B],
                            right[state_v_c] - position_ * right[state_x_c]};
    for (std::size_t i = 1; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) r[i] -= m_[i][j] * r[j];
    }
    for (std::size_t i = 4; i-- > 0;) {
      for (std::size_t j = i + 1; j < 4; ++j) r[i] -= m_[i][j] * r[j];
      r[i] *= pivot_[i];
    }
    k[state_p_P] = r[0];
    k[state_p_A] = r[1];
    k[state_p_B] = r[2];
    k[state_Q_i] = right[state_Q_i];
    k[state_x_c] = right[state_x_c] + weight_s_ * r[3];
    k[state_v_c] = r[3];
  }

 private:
  LoadKind kind_ = LoadKind::held_difference;
  Scalar weight_s_ = 0.0;
  Scalar position_ = 0.0;
  std::array<std::array<Scalar, 4>, 4> m_{};
  std::array<Scalar, 4> pivot_{};
};

}  // namespace spoolflow::rig
