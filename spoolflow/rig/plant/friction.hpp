#pragma once
/// Dry and mixed friction of one sliding pair: a generalised Maxwell-slip set with Stribeck and rest-time effects.
///
///     f_i <- clamp(f_i + k_i dx, -alpha_i W, +alpha_i W),   F = sum f_i          (pre-sliding, break-away)
///     W = level [1 + (stiction - 1 + ageing a) / (1 + (v/v_s)^2)]                 (Stribeck)
///     level <- level (1 - (1 - s) (|v| - v_1)/(v_2 - v_1))   between v_1 and v_2: friction that falls with speed
///     W <- W (1 + (n - 1) (a - 0.9 a_n)/(0.1 a_n))           up to n times at a_n, the age after a rest of t_n: silt
///     da/dt = (1 - a)/t_rest - a |v|/l_rest                                       (contact ages at rest, is wiped by
///     sliding)
///
/// `level` [N] is the sliding friction from load (spool pressure and lateral flow force, armature side force).
/// Al-Bender, Lampaert, Swevers 2005 (GMS); rest time: Armstrong-Helouvry 1994.
#include <array>
#include <cstddef>

#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct FrictionOf {
  Scalar base_N = 1.4;
  Scalar stiction_ratio = 1.25;
  Scalar ageing_gain = 3.0;
  Scalar ageing_time_s = 1.1;
  Scalar ageing_distance_m = 3.0e-5;
  Scalar stribeck_velocity_m_per_s = 4.0e-3;
  Scalar contact_stiffness_N_per_m = 4.0e6;
  Scalar viscosity_exponent = 0.12;
  Scalar wear_factor = 1.0;
  Scalar silt_factor = 1.0;
  Scalar silt_rest_s = 5.0;
  Scalar falls_to = 1.0;
  Scalar falls_from_m_per_s = 1.2e-4;
  Scalar falls_until_m_per_s = 4.8e-4;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"base_N", "N", 0, 20, "unloaded sliding friction; half the loop width of an axial-force test"},
          self.base_N);
    visit(Parameter{"stiction_ratio", "1", 1, 2.5, "break-away over sliding friction right after stopping"},
          self.stiction_ratio);
    visit(Parameter{"ageing_gain", "1", 0, 8, "what long rest adds to that ratio (oil squeezed out, silting)"},
          self.ageing_gain);
    visit(Parameter{"ageing_time_s", "s", 0.1, 1000,
                    "time constant of that growth; seconds to minutes at fine clearance. No data sheet states it: the "
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
    visit(
        Parameter{"silt_factor", "1", 1, 5, "on break-away after the rest below: dirt between spool and bore; 1: none"},
        self.silt_factor);
    visit(Parameter{"silt_rest_s", "s", 0.1, 1000, "rest of a freshly slid contact after which silt holds it"},
          self.silt_rest_s);
    visit(Parameter{"falls_to", "1", 0.2, 1, "share of sliding friction left at speed, a film that carries; 1: none"},
          self.falls_to);
    visit(Parameter{"falls_from_m_per_s", "m/s", 1e-6, 0.1, "where it begins to fall; 5 %/s of 2.4 mm"},
          self.falls_from_m_per_s);
    visit(Parameter{"falls_until_m_per_s", "m/s", 1e-6, 0.2, "where it has fallen; 20 %/s of 2.4 mm"},
          self.falls_until_m_per_s);
  }
};
using Friction = FrictionOf<double>;

inline constexpr std::size_t friction_elements = 4;

template <class Scalar>
struct FrictionStateOf {
  std::array<Scalar, friction_elements> element_N{};  ///< force of each Maxwell-slip element
  Scalar age = 0.0;                                   ///< 0 freshly slid .. 1 long at rest
};
using FrictionState = FrictionStateOf<double>;

/// Share alpha_i of the break-away level that element i carries: 1, 2, 3, 4 tenths, at equal stiffness.
inline constexpr std::array<double, friction_elements> friction_share{0.1, 0.2, 0.3, 0.4};

/// What does not change within a step; `load_factor` scales the sliding friction by wear and viscosity.
template <class Scalar>
struct FrictionConstantsOf {
  Scalar base_N;  ///< scaled
  Scalar load_factor;
  Scalar stiffness_N_per_m;  ///< of one element
  Scalar per_stiffness_m_per_N;
  Scalar stiction, ageing_gain;  ///< stiction ratio less 1
  Scalar stribeck2_m2_per_s2;
  Scalar per_ageing_time_s, per_ageing_distance_m;
  Scalar silt_gain, silt_begin, per_silt;  ///< factor less 1; age where it begins; over the age in which it grows
  Scalar falls, falls_from_m_per_s, per_fall_s_per_m;  ///< share lost; over the speeds between
};
using FrictionConstants = FrictionConstantsOf<double>;

template <class Scalar>
inline FrictionConstantsOf<Scalar> friction_constants(const FrictionOf<Scalar>& friction, Scalar viscosity_m2_per_s) {
  Scalar factor = friction.wear_factor;
  const Mask<Scalar> thickens = friction.viscosity_exponent > 0.0;
  if (any(thickens)) {
    factor = select(thickens, factor * power(viscosity_m2_per_s / 46e-6, friction.viscosity_exponent), factor);
  }
  Scalar silt_age = 1.0;
  const Mask<Scalar> silts = friction.silt_factor > 1.0;
  if (any(silts)) silt_age = 1.0 - exponential(-friction.silt_rest_s / friction.ageing_time_s);
  constexpr double least_m_per_s = 1e-6;
  const Scalar stiffness = friction.contact_stiffness_N_per_m / static_cast<Scalar>(friction_elements);
  return {.base_N = factor * friction.base_N,
          .load_factor = factor,
          .stiffness_N_per_m = stiffness,
          .per_stiffness_m_per_N = 1.0 / stiffness,
          .stiction = friction.stiction_ratio - 1.0,
          .ageing_gain = friction.ageing_gain,
          .stribeck2_m2_per_s2 = friction.stribeck_velocity_m_per_s * friction.stribeck_velocity_m_per_s,
          .per_ageing_time_s = 1.0 / friction.ageing_time_s,
          .per_ageing_distance_m = 1.0 / friction.ageing_distance_m,
          .silt_gain = friction.silt_factor - 1.0,
          .silt_begin = 0.9 * silt_age,
          .per_silt = 10.0 / silt_age,
          .falls = 1.0 - friction.falls_to,
          .falls_from_m_per_s = friction.falls_from_m_per_s,
          .per_fall_s_per_m =
              1.0 / larger(friction.falls_until_m_per_s - friction.falls_from_m_per_s, Scalar(least_m_per_s))};
}

/// Level W [N] the set can carry at a velocity; `load_N` is the load's part of the sliding friction, unscaled.
template <class Scalar>
inline Scalar breakaway_N(const FrictionConstantsOf<Scalar>& friction, Scalar load_N, Scalar age,
                          Scalar velocity_m_per_s) {
  const Scalar v2 = velocity_m_per_s * velocity_m_per_s;
  Scalar level_N = friction.base_N + friction.load_factor * load_N;
  if (any(friction.falls > 0.0)) {
    const Scalar fallen = (magnitude(velocity_m_per_s) - friction.falls_from_m_per_s) * friction.per_fall_s_per_m;
    level_N = level_N * (1.0 - friction.falls * clamped(fallen, Scalar(0.0), Scalar(1.0)));
  }
  Scalar breakaway_N = level_N * (1.0 + (friction.stiction + friction.ageing_gain * age) *
                                            friction.stribeck2_m2_per_s2 / (friction.stribeck2_m2_per_s2 + v2));
  if (any(friction.silt_gain > 0.0)) {
    const Scalar silted = (age - friction.silt_begin) * friction.per_silt;
    breakaway_N = breakaway_N * (1.0 + friction.silt_gain * clamped(silted, Scalar(0.0), Scalar(1.0)));
  }
  return breakaway_N;
}

template <class Scalar>
struct FrictionForceOf {
  Scalar force_N;            ///< sign of the motion that it resists
  Scalar stiffness_N_per_m;  ///< of the elements that stick
};

/// Force after a monotone displacement from the state; the velocity decides which elements at their limit go on
/// slipping.
template <class Scalar>
inline FrictionForceOf<Scalar> friction_force(const FrictionConstantsOf<Scalar>& friction,
                                              const FrictionStateOf<Scalar>& state, Scalar displacement_m,
                                              Scalar velocity_m_per_s, Scalar breakaway_N) {
  const Scalar change = friction.stiffness_N_per_m * displacement_m;
  const Scalar towards = select(velocity_m_per_s > 0.0, Scalar(1.0), Scalar(-1.0));
  FrictionForceOf<Scalar> sum{0.0, 0.0};
  for (std::size_t i = 0; i < friction_elements; ++i) {
    const Scalar limit = friction_share[i] * breakaway_N;
    const Scalar elastic = state.element_N[i] + change;
    sum.force_N += smaller(larger(elastic, -limit), limit);
    sum.stiffness_N_per_m += select(towards * elastic < limit, friction.stiffness_N_per_m, Scalar(0.0));
  }
  return sum;
}

/// Distance the whole set slips over a displacement: what its last element to slip cannot follow.
template <class Scalar>
inline Scalar slip_m(const FrictionConstantsOf<Scalar>& friction, const FrictionStateOf<Scalar>& state,
                     Scalar displacement_m, Scalar breakaway_N) {
  const Scalar elastic = state.element_N.back() + friction.stiffness_N_per_m * displacement_m;
  return larger(Scalar(0.0), magnitude(elastic) - friction_share.back() * breakaway_N) * friction.per_stiffness_m_per_N;
}

/// The elements after a displacement.
template <class Scalar>
inline void slide(const FrictionConstantsOf<Scalar>& friction, FrictionStateOf<Scalar>& state, Scalar displacement_m,
                  Scalar breakaway_N) {
  const Scalar change = friction.stiffness_N_per_m * displacement_m;
  for (std::size_t i = 0; i < friction_elements; ++i) {
    const Scalar limit = friction_share[i] * breakaway_N;
    state.element_N[i] = clamped(state.element_N[i] + change, -limit, limit);
  }
}

/// Contact age after a time in which the set slipped over a distance, with z the sum of both over their scales:
/// the L-stable second-order (a + (1 + z/2) dt/t_rest)/(1 + z + z^2/2), within 0 to 1. Pre-sliding renews nothing.
template <class Scalar>
inline Scalar aged(const FrictionConstantsOf<Scalar>& friction, Scalar age, Scalar slip_m, Scalar dt_s) {
  const Scalar ageing = dt_s * friction.per_ageing_time_s;
  const Scalar z = ageing + slip_m * friction.per_ageing_distance_m;
  return (age + ageing * (1.0 + 0.5 * z)) / (1.0 + z + 0.5 * z * z);
}

}  // namespace spoolflow::rig
