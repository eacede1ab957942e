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
#include <array>

#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

struct Friction {
  double base_N = 1.4;
  double stiction_ratio = 1.25;
  double ageing_gain = 0.25;
  double ageing_time_s = 8.0;
  double ageing_distance_m = 2.0e-5;
  double stribeck_velocity_m_per_s = 4.0e-3;
  double contact_stiffness_N_per_m = 1.5e6;
  double viscosity_exponent = 0.12;
  double wear_factor = 1.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"base_N", "N", 0, 20, "unloaded sliding friction; half the loop width of an axial-force test"},
          self.base_N);
    visit(Parameter{"stiction_ratio", "1", 1, 2.5, "break-away over sliding friction right after stopping"},
          self.stiction_ratio);
    visit(Parameter{"ageing_gain", "1", 0, 2, "what long rest adds to that ratio (oil squeezed out, silting)"},
          self.ageing_gain);
    visit(Parameter{"ageing_time_s", "s", 0.1, 1000,
                    "time constant of that growth; seconds to minutes at fine clearance"},
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

}  // namespace spoolflow::rig
