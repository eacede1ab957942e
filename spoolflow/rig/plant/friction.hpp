#pragma once
/// Dry and mixed friction of one sliding pair: a generalised Maxwell-slip set with Stribeck and rest-time effects.
///
///     f_i <- clamp(f_i + k_i dx, -alpha_i W, +alpha_i W),   F = sum f_i          (pre-sliding, break-away)
///     W = level [1 + (stiction - 1 + ageing a) / (1 + (v/v_s)^2)]                 (Stribeck)
///     da/dt = (1 - a)/t_rest - a |v|/l_rest                                       (contact ages at rest, is wiped by
///     sliding)
///
/// `level` [N] is the sliding friction from load (spool pressure and lateral flow force, armature side force).
/// Al-Bender, Lampaert, Swevers 2005 (GMS); rest time: Armstrong-Helouvry 1994.
#include <algorithm>
#include <array>
#include <cmath>

#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct Friction {
  double base_N = 1.4;
  double stiction_ratio = 1.25;
  double ageing_gain = 3.0;
  double ageing_time_s = 1.1;
  double ageing_distance_m = 3.0e-5;
  double stribeck_velocity_m_per_s = 4.0e-3;
  double contact_stiffness_N_per_m = 4.0e6;
  double viscosity_exponent = 0.12;
  double wear_factor = 1.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"base_N", "N", 0, 20, "unloaded sliding friction; half the loop width of an axial-force test"},
          self.base_N);
    visit(Parameter{"stiction_ratio", "1", 1, 2.5, "break-away over sliding friction right after stopping"},
          self.stiction_ratio);
    visit(Parameter{"ageing_gain", "1", 0, 8, "what long rest adds to that ratio (oil squeezed out, silting)"},
          self.ageing_gain);
    visit(Parameter{"ageing_time_s", "s", 0.1, 1000,
                    "time constant of that growth; seconds to minutes at fine clearance. No data sheet tells it: the "
                    "presets' are drawn at random between 1 and 20 s"},
          self.ageing_time_s);
    visit(Parameter{"ageing_distance_m", "m", 1e-6, 1e-3, "sliding that renews the film: some asperity lengths"},
          self.ageing_distance_m);
    visit(Parameter{"stribeck_velocity_m_per_s", "m/s", 2e-4, 0.2, "mixed friction ends at some mm/s to cm/s"},
          self.stribeck_velocity_m_per_s);
    visit(Parameter{"contact_stiffness_N_per_m", "N/m", 1e5, 2e7, "pre-sliding of 1 to 5 micrometres at break-away"},
          self.contact_stiffness_N_per_m);
    visit(Parameter{"viscosity_exponent", "1", 0, 0.5, "sliding friction follows (viscosity/46 mm2/s)^n"},
          self.viscosity_exponent);
    visit(Parameter{"wear_factor", "1", 0.2, 5, "fault: scales all sliding friction; 1 is new"}, self.wear_factor);
  }
};

inline constexpr std::size_t friction_elements = 4;

struct FrictionState {
  std::array<double, friction_elements> element_N{};  ///< force of each Maxwell-slip element
  double age = 0.0;                                   ///< 0 freshly slid .. 1 long at rest
};

/// Share alpha_i of the break-away level that element i carries: 1, 2, 3, 4 tenths, at equal stiffness.
inline constexpr std::array<double, friction_elements> friction_share{0.1, 0.2, 0.3, 0.4};

/// What does not change within a step; `load_factor` scales the sliding friction by wear and viscosity.
struct FrictionConstants {
  double base_N;  ///< scaled
  double load_factor;
  double stiffness_N_per_m;  ///< of one element
  double per_stiffness_m_per_N;
  double stiction, ageing_gain;  ///< stiction ratio less 1
  double stribeck2_m2_per_s2;
  double per_ageing_time_s, per_ageing_distance_m;
};

inline FrictionConstants friction_constants(const Friction& friction, double viscosity_m2_per_s) {
  double factor = friction.wear_factor;
  if (friction.viscosity_exponent > 0.0) factor *= power(viscosity_m2_per_s / 46e-6, friction.viscosity_exponent);
  const double stiffness = friction.contact_stiffness_N_per_m / static_cast<double>(friction_elements);
  return {.base_N = factor * friction.base_N,
          .load_factor = factor,
          .stiffness_N_per_m = stiffness,
          .per_stiffness_m_per_N = 1.0 / stiffness,
          .stiction = friction.stiction_ratio - 1.0,
          .ageing_gain = friction.ageing_gain,
          .stribeck2_m2_per_s2 = friction.stribeck_velocity_m_per_s * friction.stribeck_velocity_m_per_s,
          .per_ageing_time_s = 1.0 / friction.ageing_time_s,
          .per_ageing_distance_m = 1.0 / friction.ageing_distance_m};
}

/// Level W [N] the set can carry at a velocity; `load_N` is the load's part of the sliding friction, unscaled.
inline double breakaway_N(const FrictionConstants& friction, double load_N, double age, double velocity_m_per_s) {
  const double v2 = velocity_m_per_s * velocity_m_per_s;
  return (friction.base_N + friction.load_factor * load_N) *
         (1.0 + (friction.stiction + friction.ageing_gain * age) * friction.stribeck2_m2_per_s2 /
                    (friction.stribeck2_m2_per_s2 + v2));
}

struct FrictionForce {
  double force_N;            ///< sign of the motion that it resists
  double stiffness_N_per_m;  ///< of the elements that stick
};

/// Force after a monotone displacement from the state; the velocity tells which elements at their limit go on slipping.
inline FrictionForce friction_force(const FrictionConstants& friction, const FrictionState& state,
                                    double displacement_m, double velocity_m_per_s, double breakaway_N) {
  const double change = friction.stiffness_N_per_m * displacement_m;
  const double towards = velocity_m_per_s > 0.0 ? 1.0 : -1.0;
  FrictionForce sum{0.0, 0.0};
  for (std::size_t i = 0; i < friction_elements; ++i) {
    const double limit = friction_share[i] * breakaway_N;
    const double elastic = state.element_N[i] + change;
    sum.force_N += std::min(std::max(elastic, -limit), limit);
    sum.stiffness_N_per_m += towards * elastic < limit ? friction.stiffness_N_per_m : 0.0;
  }
  return sum;
}

/// Distance the whole set slips over a displacement: what its last element to slip cannot follow.
inline double slip_m(const FrictionConstants& friction, const FrictionState& state, double displacement_m,
                     double breakaway_N) {
  const double elastic = state.element_N.back() + friction.stiffness_N_per_m * displacement_m;
  return std::max(0.0, std::abs(elastic) - friction_share.back() * breakaway_N) * friction.per_stiffness_m_per_N;
}

/// The elements after a displacement.
inline void slide(const FrictionConstants& friction, FrictionState& state, double displacement_m, double breakaway_N) {
  const double change = friction.stiffness_N_per_m * displacement_m;
  for (std::size_t i = 0; i < friction_elements; ++i) {
    const double limit = friction_share[i] * breakaway_N;
    state.element_N[i] = std::clamp(state.element_N[i] + change, -limit, limit);
  }
}

/// Contact age after a time in which the set slipped over a distance, with z the sum of both over their scales:
/// the L-stable second-order (a + (1 + z/2) dt/t_rest)/(1 + z + z^2/2), within 0 to 1. Pre-sliding renews nothing.
inline double aged(const FrictionConstants& friction, double age, double slip_m, double dt_s) {
  const double ageing = dt_s * friction.per_ageing_time_s;
  const double z = ageing + slip_m * friction.per_ageing_distance_m;
  return (age + ageing * (1.0 + 0.5 * z)) / (1.0 + z + 0.5 * z * z);
}

}  // namespace spoolflow::rig
