#pragma once
/// Geometry of the solenoid's magnetic circuit: coil leakage parallel to [iron + radial gap armature to tube + working
/// gap].
///
///     N i - j = l H(Phi/A) + Phi (R_r + 1/P_g(x)),    lambda = N Phi + N^2 P_leak i
///
/// Working gap with a plunging, slightly conical pole (stroke s towards the pole, plunge depth L = L0 + s smoothed over
/// the edge's fringing field):
///
///     P_g(s) = mu0 2 pi r / tan(beta) ln(1 + L tan(beta)/c)  +  mu0 A_face/(g_face - s)
///
/// The first term's slope falls with the plunge, so the force grows with the gap, as proportional magnets are built
/// for; the second is the flat face behind an anti-stick disc. Leaves out the local saturation of the cone's edge
/// (its effect is inside the iron section's).
#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

struct MagneticCircuit {
  double iron_area_m2 = 2.2e-4;
  double iron_length_m = 0.12;
  double armature_radius_m = 9.0e-3;
  double radial_gap_m = 0.20e-3;
  double radial_gap_length_m = 18.0e-3;
  double cone_clearance_m = 0.55e-3;
  double cone_slope = 0.05;
  double plunge_at_rest_m = 1.0e-3;
  double fringe_length_m = 1.5e-3;
  double face_area_m2 = 4.0e-5;
  double face_gap_at_rest_m = 5.0e-3;
  double leakage_permeance_H = 3.0e-8;
  double eccentricity = 0.3;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"iron_area_m2", "m2", 5e-5, 2e-3, "armature of 18 mm less its push-rod bore"}, self.iron_area_m2);
    visit(Parameter{"iron_length_m", "m", 0.03, 0.5, "once round armature, pole, yoke and tube of a 45 mm coil"},
          self.iron_length_m);
    visit(Parameter{"armature_radius_m", "m", 3e-3, 3e-2, "18 mm armature"}, self.armature_radius_m);
    visit(Parameter{"radial_gap_m", "m", 5e-5, 1e-3, "PTFE film or brass tube wall between armature and tube"},
          self.radial_gap_m);
    visit(Parameter{"radial_gap_length_m", "m", 3e-3, 8e-2, "length over which flux enters the armature"},
          self.radial_gap_length_m);
    visit(Parameter{"cone_clearance_m", "m", 1e-4, 3e-3, "effective clearance armature to control cone"},
          self.cone_clearance_m);
    visit(Parameter{"cone_slope", "1", 0.005, 0.6, "tangent by which that clearance widens with the plunge depth"},
          self.cone_slope);
    visit(Parameter{"plunge_at_rest_m", "m", -2e-3, 8e-3, "depth of the armature inside the cone at spool centre"},
          self.plunge_at_rest_m);
    visit(Parameter{"fringe_length_m", "m", 1e-4, 6e-3, "over which the edge's stray field starts to pull"},
          self.fringe_length_m);
    visit(Parameter{"face_area_m2", "m2", 0, 1e-3, "flat part of the armature's face opposite the pole"},
          self.face_area_m2);
    visit(Parameter{"face_gap_at_rest_m", "m", 4.5e-3, 2e-2, "face gap at spool centre; exceeds stroke and end stop"},
          self.face_gap_at_rest_m);
    visit(Parameter{"leakage_permeance_H", "H", 2e-9, 1e-6, "coil flux that closes through air beside the armature"},
          self.leakage_permeance_H);
    visit(Parameter{"eccentricity", "1", 0, 0.9, "armature offset over radial gap; makes the side force"},
          self.eccentricity);
  }
};

}  // namespace spoolflow::rig
