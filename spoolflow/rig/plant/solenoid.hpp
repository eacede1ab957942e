#pragma once
/// One proportional solenoid: winding, its heat, magnetic circuit, iron, hysteresis, eddy currents, armature friction.
///
///     dlambda/dt = u - R(T) i,   lambda = N Phi + N^2 P_leak i
///     dPhi/dt    = e             (from the magnetomotive balance over the eddy ladder)
///     F_mag      = (Phi/P_g)^2/2 dP_g/ds      = dW_co/ds at constant currents
///
/// Force, flux linkage and current are positive for current into the positive terminal; the force always pulls the
/// armature to its own pole.
#include "spoolflow/rig/plant/coil.hpp"
#include "spoolflow/rig/plant/coil_heat.hpp"
#include "spoolflow/rig/plant/eddy_currents.hpp"
#include "spoolflow/rig/plant/friction.hpp"
#include "spoolflow/rig/plant/magnetic_circuit.hpp"
#include "spoolflow/rig/plant/magnetic_hysteresis.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct SolenoidOf {
  CoilOf<Scalar> coil;
  CoilHeatOf<Scalar> heat;
  MagneticCircuitOf<Scalar> circuit;
  MagneticMaterialOf<Scalar> iron;
  MagneticHysteresisOf<Scalar> hysteresis;
  EddyCurrentsOf<Scalar> eddy;
  FrictionOf<Scalar> friction{.base_N = 0.3,
                              .stiction_ratio = 1.2,
                              .ageing_gain = 0.2,
                              .ageing_time_s = 10.0,
                              .ageing_distance_m = 3e-5,
                              .contact_stiffness_N_per_m = 1.0e6,
                              .viscosity_exponent = 0.0};
  Scalar side_friction_coefficient = 0.06;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("coil", self.coil);
    visit("heat", self.heat);
    visit("circuit", self.circuit);
    visit("iron", self.iron);
    visit("hysteresis", self.hysteresis);
    visit("eddy", self.eddy);
    visit("friction", self.friction);
    visit(Parameter{"side_friction_coefficient", "1", 0, 0.4, "armature on PTFE film 0.05 to 0.1, on brass 0.15"},
          self.side_friction_coefficient);
  }
};
using Solenoid = SolenoidOf<double>;

template <class Scalar>
struct SolenoidStateOf {
  Scalar flux_linkage_Wb = 0.0;  ///< of the winding
  Scalar flux_Wb = 0.0;          ///< through iron and working gap
  Scalar skin_current_A = 0.0;   ///< j_2 of the eddy ladder
  IronMemoryOf<Scalar> iron;
  CoilHeatStateOf<Scalar> heat;
  FrictionStateOf<Scalar> friction;
};
using SolenoidState = SolenoidStateOf<double>;

}  // namespace spoolflow::rig
