#pragma once
/// The matrix A of the plant's integrator: what is stiff, block by block. Each solenoid's three states, the body's
/// contacts and drag, the volumes with the cylinder. What couples the blocks is slow against a step and is left out.
#include "spoolflow/rig/plant/plant_dynamics.hpp"

namespace spoolflow::rig {

/// The body's pair of states: (1 - w J) k = r with contact stiffness and damping.
template <class Scalar>
struct BodySolver {
  Scalar weight_s, stiffness_per_s2, pivot;

  BodySolver(const PlantConstantsOf<Scalar>& constants, const PlantRatesOf<Scalar>& point, Scalar w) : weight_s(w) {
    Scalar flow_damping = 0.0;
    if (constants.hydraulics) {
      for (std::size_t i = 0; i < 4; ++i) {
        flow_damping -= constants.density_kg_per_m3 * constants.edges[i]->damping_length_m *
                        point.hydraulics.edges[i].flow_gain_m2_per_s;
      }
    }
    const Scalar stiffness = point.spring.stiffness_N_per_m + point.spool_friction.stiffness_N_per_m +
                             point.armature_a_friction.stiffness_N_per_m + point.armature_b_friction.stiffness_N_per_m +
                             point.end_stop.stiffness_N_per_m;
    const Scalar damping = constants.spool_drag_N_s_per_m + constants.armature_drag_N_s_per_m +
                           point.end_stop.damping_N_s_per_m + larger(Scalar(0.0), flow_damping);
    stiffness_per_s2 = stiffness / constants.mass_kg;
    pivot = 1.0 / (1.0 + w * (damping / constants.mass_kg + w * stiffness_per_s2));
  }

  void operator()(const PlantVectorOf<Scalar>& right, PlantVectorOf<Scalar>& k) const {
    k[state_v] = (right[state_v] - weight_s * stiffness_per_s2 * right[state_x]) * pivot;
    k[state_x] = right[state_x] + weight_s * k[state_v];
  }
};

/// (1 - w A) k = r for the whole plant, block by block.
template <class Scalar>
struct PlantSolver {
  BodySolver<Scalar> body;
  SolenoidSolver<Scalar> solenoid_a, solenoid_b;
  HydraulicSolver<Scalar> hydraulics;

  PlantSolver(const PlantParametersOf<Scalar>& p, const PlantConstantsOf<Scalar>& c, const PlantRatesOf<Scalar>& point,
              Scalar w)
      : body(c, point, w) {
    if (c.magnetic_a) solenoid_a = SolenoidSolver<Scalar>(c.solenoid_a_constants, point.solenoid_a, w);
    if (c.magnetic_b) solenoid_b = SolenoidSolver<Scalar>(c.solenoid_b_constants, point.solenoid_b, w);
    if (c.hydraulics) hydraulics = HydraulicSolver<Scalar>(p.supply, p.load, point.hydraulics, w);
  }

  void operator()(const PlantConstantsOf<Scalar>& c, const PlantVectorOf<Scalar>& right,
                  PlantVectorOf<Scalar>& k) const {
    body(right, k);
    if (c.magnetic_a) solenoid_a(solenoid_a_of(right), solenoid_a_of(k));
    if (c.magnetic_b) solenoid_b(solenoid_b_of(right), solenoid_b_of(k));
    if (c.hydraulics) hydraulics(hydraulics_of(right), hydraulics_of(k));
  }
};

}  // namespace spoolflow::rig
