#pragma once
/// Moving parts: one spool with two armatures and push rods, which the springs keep together as one body.
///
///     (m_hydr + n m_act) dv/dt = F_mag - F_fric,act - F_spr - F_ff - F_fric,hydr - F_drag - F_stop
///
/// x > 0 opens P to B (and A to T) and is what solenoid b pulls to. Drag is laminar shear in the clearance plus oil
/// displaced through the armatures' bores, both proportional to the dynamic viscosity.
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct SpoolOf {
  Scalar spool_mass_kg = 0.060;
  Scalar armature_mass_kg = 0.055;
  Scalar stroke_m = 2.4e-3;
  Scalar end_stop_m = 2.5e-3;
  Scalar end_stop_stiffness_N_per_m = 2.0e7;
  Scalar end_stop_damping_s_per_m = 1.5;
  Scalar washer_play_m = 15.0e-6;
  Scalar diameter_m = 12.0e-3;
  Scalar land_length_m = 28.0e-3;
  Scalar clearance_m = 5.0e-6;
  Scalar armature_drag_m = 250.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"spool_mass_kg", "kg", 0.02, 1, "steel spool of 12 mm, 70 mm long"}, self.spool_mass_kg);
    visit(Parameter{"armature_mass_kg", "kg", 0.01, 0.5, "each; armature of 18 mm, 30 mm long, with push rod"},
          self.armature_mass_kg);
    visit(Parameter{"stroke_m", "m", 5e-4, 4e-3, "position at 100 % of set value; size 6: 2 to 3 mm"}, self.stroke_m);
    visit(Parameter{"end_stop_m", "m", 5e-4, 4.3e-3, "where the push rod meets the pole; beyond the stroke"},
          self.end_stop_m);
    visit(Parameter{"end_stop_stiffness_N_per_m", "N/m", 3e6, 2e8, "steel on an anti-stick disc: 1e7 to 1e8"},
          self.end_stop_stiffness_N_per_m);
    visit(Parameter{"end_stop_damping_s_per_m", "s/m", 0, 10, "Hunt-Crossley factor; 1.5 rebounds at about half speed"},
          self.end_stop_damping_s_per_m);
    visit(Parameter{"washer_play_m", "m", 1e-6, 1e-4,
                    "axial play of the springs' washers, over which the centring force changes over"},
          self.washer_play_m);
    visit(Parameter{"diameter_m", "m", 4e-3, 4e-2, "size 6: 10 to 12 mm; size 10: 16 to 20 mm"}, self.diameter_m);
    visit(Parameter{"land_length_m", "m", 5e-3, 0.2, "sum of the sealing lands"}, self.land_length_m);
    visit(Parameter{"clearance_m", "m", 1e-6, 3e-5, "radial; selectively fitted spools 3 to 8 micrometres"},
          self.clearance_m);
    visit(Parameter{"armature_drag_m", "m", 0, 5000, "each; drag over dynamic viscosity: 10 N s/m at 40 C"},
          self.armature_drag_m);
  }
};
using Spool = SpoolOf<double>;

/// Contact of the push rod with the pole at either end of the travel (Hunt and Crossley 1975):
///
///     F = k d (1 + c dd/dt) >= 0,   d the depth beyond the end stop
template <class Scalar>
struct EndStopForceOf {
  Scalar force_N;  ///< towards -x
  Scalar stiffness_N_per_m;
  Scalar damping_N_s_per_m;
};

template <class Scalar>
inline EndStopForceOf<Scalar> end_stop_force(const SpoolOf<Scalar>& spool, Scalar position_m, Scalar velocity_m_per_s) {
  const Scalar depth = magnitude(position_m) - spool.end_stop_m;
  const Mask<Scalar> touches = !(depth <= 0.0);
  if (!any(touches)) return {0.0, 0.0, 0.0};
  const Scalar side = select(position_m > 0.0, Scalar(1.0), Scalar(-1.0));
  const Scalar stiffness = spool.end_stop_stiffness_N_per_m;
  const Scalar push =
      stiffness * depth * larger(Scalar(0.0), 1.0 + spool.end_stop_damping_s_per_m * side * velocity_m_per_s);
  return {select(touches, side * push, Scalar(0.0)), select(touches, stiffness, Scalar(0.0)),
          select(touches, stiffness * depth * spool.end_stop_damping_s_per_m, Scalar(0.0))};
}

}  // namespace spoolflow::rig
