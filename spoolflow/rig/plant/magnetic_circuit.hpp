#pragma once
/// Geometry of the solenoid's magnetic circuit: coil leakage parallel to [iron + radial gap armature to tube + working
/// gap].
///
///     N i - j = l H(Phi/A) + Phi (R_r + 1/P_g(x)),    lambda = N Phi + N^2 P_leak i
///
/// Working gap with a plunging, slightly conical pole (stroke s towards the pole, plunge depth L = L0 + s smoothed over
/// the edge's fringing field):
///
///     P_g(s) = mu0 2 pi r L/(c + L tan(beta)/2)  +  mu0 A_face/(g_face - s)
///
/// The first is the cone's mu0 2 pi r/tan(beta) ln(1 + z), z = L tan(beta)/c, with ln(1 + z) taken as z/(1 + z/2)
/// (within 0.2 % below z = 0.15; the force is the exact slope of what stands here, so energy is kept whatever z). Its
/// slope falls with the plunge, so the force grows with the gap, as proportional magnets are built for; the second is
/// the flat face behind an anti-stick disc. Leaves out the local saturation of the cone's edge (its effect is inside
/// the iron section's).
#include <numbers>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct MagneticCircuitOf {
  Scalar iron_area_m2 = 3.1e-4;
  Scalar iron_length_m = 0.08;
  Scalar armature_radius_m = 10.5e-3;
  Scalar radial_gap_m = 0.20e-3;
  Scalar radial_gap_length_m = 18.0e-3;
  Scalar cone_clearance_m = 0.78e-3;
  Scalar cone_slope = 0.03;
  Scalar plunge_at_rest_m = 0.8e-3;
  Scalar fringe_length_m = 1.0e-3;
  Scalar face_area_m2 = 6.0e-5;
  Scalar face_gap_at_rest_m = 5.0e-3;
  Scalar leakage_permeance_H = 3.0e-8;
  Scalar eccentricity = 0.2;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"iron_area_m2", "m2", 5e-5, 2e-3, "armature of 21 mm less its push-rod bore"}, self.iron_area_m2);
    visit(
        Parameter{"iron_length_m", "m", 0.03, 0.5, "narrow part of the path: armature, pole and tube of a 45 mm coil"},
        self.iron_length_m);
    visit(Parameter{"armature_radius_m", "m", 3e-3, 3e-2, "21 mm armature of a 45 mm coil"}, self.armature_radius_m);
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

/// Permeance of the working gap and its slope.
template <class Scalar>
struct GapPermeanceOf {
  Scalar permeance_H;
  Scalar slope_H_per_m;  ///< dP/ds, >= 0
};

/// The gap's constants.
template <class Scalar>
struct WorkingGapOf {
  Scalar plunge_m, fringe_m2;
  Scalar rim_H;        ///< mu0 2 pi r
  Scalar clearance_m;  ///< c
  Scalar half_slope;   ///< tan(beta)/2
  Scalar face_H_m;     ///< mu0 A_face
  Scalar face_gap_m;
};

template <class Scalar>
inline WorkingGapOf<Scalar> working_gap(const MagneticCircuitOf<Scalar>& circuit) {
  return {circuit.plunge_at_rest_m,
          circuit.fringe_length_m * circuit.fringe_length_m,
          vacuum_permeability_H_per_m * 2.0 * std::numbers::pi * circuit.armature_radius_m,
          circuit.cone_clearance_m,
          0.5 * circuit.cone_slope,
          vacuum_permeability_H_per_m * circuit.face_area_m2,
          circuit.face_gap_at_rest_m};
}

/// The anti-stick disc keeps the face off its pole however hard the end stop is hit.
inline constexpr double anti_stick_m = 5e-5;

/// At the armature's travel s towards its pole, counted from spool centre.
template <class Scalar>
inline GapPermeanceOf<Scalar> gap_permeance(const WorkingGapOf<Scalar>& gap, Scalar travel_m) {
  const Scalar depth = travel_m + gap.plunge_m;
  const Scalar root = square_root(depth * depth + gap.fringe_m2);
  const Scalar plunge = 0.5 * (depth + root);
  const Scalar per_cone = 1.0 / (gap.clearance_m + gap.half_slope * plunge);
  const Scalar cone = gap.rim_H * per_cone * plunge;
  const Scalar per_face = 1.0 / larger(gap.face_gap_m - travel_m, anti_stick_m);
  const Scalar face = gap.face_H_m * per_face;
  return {cone + face, cone * gap.clearance_m * per_cone / root + face * per_face};
}

/// Reluctance [1/H] of the radial gap with the armature off centre: R0 sqrt(1 - eccentricity^2).
template <class Scalar>
inline Scalar radial_reluctance_per_H(const MagneticCircuitOf<Scalar>& circuit) {
  return circuit.radial_gap_m /
         (vacuum_permeability_H_per_m * 2.0 * std::numbers::pi * circuit.armature_radius_m *
          circuit.radial_gap_length_m) *
         square_root(1.0 - circuit.eccentricity * circuit.eccentricity);
}

/// Side force over flux squared [N/Wb2]: -dR/de/2 of the radial gap over its width, F = Phi^2 R0 ecc/(2 g
/// sqrt(1-ecc^2)).
template <class Scalar>
inline Scalar side_force_per_flux_squared(const MagneticCircuitOf<Scalar>& circuit) {
  return 0.5 * radial_reluctance_per_H(circuit) * circuit.eccentricity /
         (circuit.radial_gap_m * (1.0 - circuit.eccentricity * circuit.eccentricity));
}

}  // namespace spoolflow::rig
